"""Each finding of the doctor, from facts made up for it."""

import errno
from dataclasses import replace

import pytest

from tutorial_tools.doctor.facts import Answer, Facts, Joystick, Mux, MuxInput, Node, Offset, some
from tutorial_tools.doctor.judgement import judge

JOY, TWIST = "sensor_msgs/Joy", "geometry_msgs/Twist"
TELEOP = "/cmd_vel_mux/input/teleop"
SAFETY = "/cmd_vel_mux/input/safety_controller"
NAVI = "/cmd_vel_mux/input/navi"


def node(host="here", answer=Answer.WELL, here=True, links=()):
    return Node(f"http://{host}:1234/", host, answer, here, list(links))


# A workstation whose joystick drives a TurtleBot on another machine.
WELL = Facts(
    master_uri="http://robot:11311",
    master_host="robot",
    master_here=False,
    own_variable="ROS_IP",
    own_name="10.0.0.2",
    own_addresses=["10.0.0.2"],
    way_out="10.0.0.2",
    joysticks=[Joystick("/dev/input/js0")],
    nodes={
        "/joy_node": node("10.0.0.2"),
        "/joy2twist": node("10.0.0.2", links=[("/joy", True), (TELEOP, False)]),
        "/cmd_vel_mux": node("robot", here=False, links=[(TELEOP, True)]),
    },
    publishers={"/joy": ["/joy_node"], TELEOP: ["/joy2twist"]},
    subscribers={"/joy": ["/joy2twist"], TELEOP: ["/cmd_vel_mux"]},
    types={"/joy": JOY, TELEOP: TWIST, "/left": TWIST},
    clocks={"robot": Offset(0.002, "/odom")},
    muxes={
        "/cmd_vel_mux": Mux(
            "teleop",
            [MuxInput("safety", SAFETY, 10), MuxInput("teleop", TELEOP, 7), MuxInput("n", NAVI, 5)],
        )
    },
    states={"/joy2twist": (True, "driving")},
)


def with_node(name, value):
    """The well facts with one node changed."""
    return replace(WELL, nodes={**WELL.nodes, name: value})


def lines(facts, level):
    return [finding.line() for finding in judge(facts) if finding.level == level]


def wrong(facts, *words):
    """The one line that is wrong has these words."""
    (line,) = lines(facts, "wrong")
    for word in words:
        assert word in line


def test_all_is_well():
    findings = judge(WELL)
    assert {finding.level for finding in findings} == {"ok"}
    told = [finding.about for finding in findings]
    assert told == [
        "floor", "master", "address", "nodes", "clocks", "topics", "mux", "state", "joystick",
    ]  # fmt: skip
    assert f"/joy_node -> /joy -> /joy2twist -> {TELEOP} -> /cmd_vel_mux" in findings[5].line()


@pytest.mark.parametrize(
    ("workspace", "path", "level", "words"),
    [
        ("", "/suite/joy2twist", "ok", "is the suite's: /suite/joy2twist"),
        ("", "", "unknown", "no joy2twist is found here: call this through ./tutorial"),
        ("/ws", "/ws/src/joy2twist", "ok", "is yours: /ws/src/joy2twist"),
        ("/ws", "", "unknown", "has no joy2twist yet: make it in /ws/src"),
        ("/ws", "/suite/joy2twist", "wrong", "is not in your workspace: /suite/joy2twist"),
        ("/ws", "/ws/joy2twist", "wrong", "mv it into /ws/src"),
    ],
)
def test_whose_joy2twist_would_run(workspace, path, level, words):
    findings = judge(Facts(workspace=workspace, joy2twist=path))
    assert (findings[0].level, findings[0].about) == (level, "floor")
    assert words in findings[0].line()


def test_a_broken_package_xml_is_named():
    broken = [("/ws/src/a/package.xml", "mismatched tag: line 5"), ("/ws/src/b/package.xml", "x")]
    findings = judge(Facts(workspace="/ws", joy2twist="", broken_manifests=broken))
    told = [finding.line() for finding in findings if finding.about == "floor"]
    assert len(told) == 2
    for line, (path, why) in zip(told, broken):
        assert line.startswith("wrong") and f"{path}: {why}" in line and "no ROS program" in line


def test_each_finding_is_one_line():
    for finding in judge(WELL):
        assert "\n" not in finding.line()


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (Answer.MALFORMED, ["ROS_MASTER_URI=http://robot:11311", "http://HOST:PORT", "export"]),
        (Answer.UNKNOWN_NAME, ["looked up", '"robot"', "/etc/hosts"]),
        (Answer.REFUSED, ["start roscore, or minimal.launch, on robot"]),
        (Answer.SILENT, ["does not answer", "ping robot", "firewall"]),
        (Answer.STRANGE, ["not of ROS", "end that program"]),
    ],
)
def test_master(answer, words):
    facts = Facts(**{**vars(WELL), "master": answer, "called_back": None})
    wrong(facts, "master", *words)
    # Nothing is said of a graph that was not seen.
    assert {finding.about for finding in judge(facts)} == {"floor", "master", "address", "joystick"}


def test_a_master_of_this_machine_is_to_be_started_here():
    facts = Facts(master=Answer.REFUSED, master_here=True, called_back=None)
    wrong(facts, ": start roscore; or")


def test_an_own_address_of_another_machine():
    facts = replace(WELL, own_name="10.0.0.9", own_addresses=["10.0.0.9"], own_is_here=False)
    facts = replace(facts, called_back=None)
    wrong(facts, "ROS_IP=10.0.0.9 is no address of this machine", "export ROS_IP=10.0.0.2")


def test_an_own_name_that_cannot_be_looked_up():
    facts = replace(WELL, own_variable="", own_name="desk", own_addresses=[], own_is_here=False)
    wrong(replace(facts, called_back=None), 'the name "desk"', "export ROS_IP=10.0.0.2")


def test_an_own_address_that_only_this_machine_knows():
    facts = replace(WELL, own_variable="ROS_HOSTNAME", own_name="localhost", called_back=False)
    facts = replace(facts, own_addresses=["127.0.0.1"])
    wrong(facts, "ROS_HOSTNAME=localhost is seen by this machine only", "export ROS_IP=10.0.0.2")


def test_a_master_that_does_not_reach_us():
    facts = replace(WELL, own_variable="", own_name="desk", called_back=False)
    wrong(facts, 'the master does not reach "desk"', "export ROS_IP=10.0.0.2", "firewall")


def test_without_another_machine_the_variables_are_not_needed():
    facts = Facts(own_variable="ROS_IP", own_name="1.2.3.4", own_addresses=["1.2.3.4"])
    facts = replace(facts, own_is_here=False, called_back=None)
    assert "unset ROS_IP ROS_HOSTNAME" in lines(facts, "wrong")[0]


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (node("robot", Answer.UNKNOWN_NAME, None), ['"robot" cannot be looked up', "/etc/hosts"]),
        (node("robot", Answer.REFUSED, False), ["has died", "rosnode cleanup"]),
        (node("robot", Answer.STRANGE, False), ["has died", "rosnode cleanup"]),
        (node("robot", Answer.SILENT, False), ["does not answer", "ping robot"]),
        (node("localhost", Answer.WELL), ["from its own machine only", "export ROS_IP"]),
        (node("127.0.1.1", Answer.REFUSED), ["from its own machine only", "export ROS_IP"]),
    ],
)
def test_a_node(changed, words):
    wrong(with_node("/cmd_vel_mux", changed), f"/cmd_vel_mux at {changed.uri}", *words)


def test_a_local_node_is_of_no_use_to_a_robot_elsewhere():
    facts = replace(with_node("/joy_node", node("localhost")), master_here=True, way_out="")
    wrong(facts, "/joy_node", "own machine only")


def test_a_dead_local_node_may_be_another_machines():
    nodes = {"/a": node("localhost", Answer.REFUSED)}
    (line,) = [line for line in lines(Facts(nodes=nodes), "wrong") if "nodes" in line]
    assert "has died" in line
    assert "if it runs on another machine" in line


@pytest.mark.parametrize(("seconds", "level"), [(0.1, "ok"), (-0.1, "ok"), (0.11, "wrong")])
def test_clocks_may_differ_by_a_tenth_of_a_second(seconds, level):
    facts = replace(WELL, clocks={"robot": Offset(seconds, "/odom")})
    assert len([line for line in lines(facts, level) if "clocks" in line]) == 1


def test_clocks_that_differ():
    wrong(replace(WELL, clocks={"robot": Offset(3.21, "/odom")}), "3.2 s ahead of us, by /odom")
    wrong(replace(WELL, clocks={"robot": Offset(-3.21, "/odom")}), "3.2 s behind us", "chrony")


def test_a_clock_that_nothing_tells_of():
    (line,) = lines(replace(WELL, clocks={"robot": None}), "unknown")
    assert "robot sends no stamped message: compare: date" in line


def test_clocks_of_one_machine():
    assert any("every node runs on this machine" in line for line in lines(Facts(), "ok"))


def test_simulated_time():
    facts = replace(WELL, use_sim_time=True, clocks={"robot": Offset(99.0, "/odom")})
    wrong(facts, "/use_sim_time is true, and no /clock comes", "rosparam delete")
    assert not lines(replace(facts, clock_ticks=True), "wrong")


def test_an_empty_graph():
    (line,) = lines(Facts(), "wrong")
    assert "neither a joystick nor joy2twist: roslaunch joy2twist launch_joy_node.launch" in line


def test_a_classroom():
    """The advice has the namespace of the robot, and another joystick than a gamepad."""
    velocities = {f"/robot_{number}/cmd_vel": ["/classroom"] for number in (2, 10)}
    types = dict.fromkeys(velocities, TWIST)
    classroom = replace(Facts(), subscribers=velocities, types=types)
    wrong(classroom, "roslaunch joy2twist student.launch name:=robot_2", "joystick:=browser")
    joy, velocity = "/robot_2/joy", "/robot_2/cmd_vel"
    types = {**types, joy: JOY}
    subscribers = {**velocities, joy: ["/robot_2/joy2twist"]}
    publishers = {velocity: ["/robot_2/joy2twist"]}
    states = {"/robot_2/joy2twist": (False, "waiting for the joystick")}
    listening = Facts(subscribers=subscribers, publishers=publishers, types=types, states=states)
    silent, state = lines(listening, "wrong")
    for word in ("joy_node __ns:=/robot_2", "FILE /joy:=/robot_2/joy", "joystick:=browser"):
        assert word in silent
    assert "rostopic hz /robot_2/joy" in state and "joystick:=browser" in state
    sending = replace(Facts(), subscribers=velocities, publishers={joy: ["/pad"]}, types=types)
    wrong(sending, "rosrun joy2twist joy2twist.py __ns:=/robot_2")


def test_a_robot_with_a_mux_alone():
    facts = replace(WELL, publishers={}, subscribers={TELEOP: ["/cmd_vel_mux"]})
    wrong(facts, "neither a joystick nor joy2twist", "launch_joy_node_realTurtlebot.launch")


def test_a_way_through_a_dead_node_is_none():
    facts = with_node("/joy2twist", node("10.0.0.2", Answer.REFUSED))
    wrong(facts, "/joy2twist", "has died")
    assert not [line for line in lines(facts, "ok") if " -> " in line]


def test_a_mux_that_waits_for_neutral_after_a_cut():
    wrong(mux("idle"), "though /joy2twist drives", "release LB and the sticks")


def test_nobody_sends_joy():
    facts = replace(WELL, publishers={TELEOP: ["/joy2twist"]}, joysticks=[])
    wrong(facts, "nobody sends /joy", "rosrun joy joy_node, or: rosbag play FILE;")
    (line,) = lines(facts, "unknown")
    assert "No joystick at /dev/input/js0: plug it in" in line


def test_nobody_makes_velocities():
    facts = replace(WELL, publishers={"/joy": ["/joy_node"]}, subscribers={"/joy": ["/echo"]})
    wrong(facts, "nobody makes velocities of /joy", "joy2twist_turtlebot.launch")
    wrong(replace(facts, muxes={}), "rosrun joy2twist joy2twist.py")


def test_nobody_listens():
    facts = replace(WELL, subscribers={"/joy": ["/joy2twist"], "/left": ["/robot"]}, muxes={})
    wrong(facts, f"nobody listens to {TELEOP} of /joy2twist", "or drive the one at /left")


@pytest.mark.parametrize("kept", [("/joy", True), (TELEOP, False)])
def test_known_but_not_connected(kept):
    lost = TELEOP if kept[1] else "/joy"
    facts = with_node("/joy2twist", node("10.0.0.2", links=[kept]))
    wrong(facts, f"{lost}: ", "know of each other, but are not connected")


def test_a_converter_that_has_just_left_is_no_error():
    facts = with_node("/joy2twist", node())
    del facts.nodes["/joy2twist"]
    assert not lines(facts, "wrong")


def test_several_drive_one_robot():
    publishers = {**WELL.publishers, TELEOP: ["/joy2twist", "/keyboard"]}
    seen = f"{TELEOP} is sent by /joy2twist, /keyboard at once: end all of them but one"
    wrong(replace(WELL, publishers=publishers), seen)


def test_several_joysticks():
    publishers = {**WELL.publishers, "/joy": ["/joy_node", "/rosbag"]}
    wrong(replace(WELL, publishers=publishers), "/joy is sent by /joy_node, /rosbag at once")


def mux(active, inputs=WELL.muxes["/cmd_vel_mux"].inputs):
    return replace(WELL, muxes={"/cmd_vel_mux": Mux(active, list(inputs))})


def test_a_mux_that_lets_another_through():
    facts = mux("safety")
    wrong(facts, f'lets "safety" through, and not {TELEOP}: end what sends to that')
    facts.publishers[SAFETY] = ["/bumper"]
    facts.types[SAFETY] = TWIST
    wrong(facts, "end /bumper")
    del facts.publishers[SAFETY], facts.types[SAFETY]


@pytest.mark.parametrize("active", ["teleop", "idle", "", "n"])
def test_a_mux_that_would_let_us_through(active):
    facts = replace(mux(active), states={"/joy2twist": (True, "armed")})
    assert not lines(facts, "wrong")


@pytest.mark.parametrize(
    ("active", "level"), [("Teleoperation", "ok"), ("idle", "ok"), ("Navigation", "wrong")]
)
def test_a_mux_with_its_inputs_in_a_file(active, level):
    facts = replace(mux(active, []), states={"/joy2twist": (True, "armed")})
    assert [line for line in lines(facts, level) if "mux  " in line]


def test_a_mux_that_says_nothing():
    (line,) = lines(mux(None), "unknown")
    assert "rostopic echo /cmd_vel_mux/active" in line


def test_what_joy2twist_says():
    state = "stopped: not armed, release the sticks and the dead-man button once"
    wrong(replace(WELL, states={"/joy2twist": (False, state)}), f"/joy2twist says: {state}")
    state = "stopped: no message for 0.5 s"
    wrong(replace(WELL, states={"/joy2twist": (False, state)}), "move the joystick, or start it")


def test_joysticks():
    denied = [Joystick("/dev/input/js0", errno.EACCES)]
    wrong(replace(WELL, joysticks=denied), "No permission to read /dev/input/js0", "usermod")
    gone = [Joystick("/dev/input/js1", errno.ENOENT)]
    wrong(replace(WELL, joysticks=gone, container=True), "--device /dev/input/js1")


def test_without_a_gamepad_another_sends():
    facts = replace(WELL, joysticks=[])
    assert any("joystick messages come from /joy_node" in line for line in lines(facts, "ok"))


def test_a_sender_that_has_died_is_no_rival():
    """A recording that was killed, and its successor."""
    publishers = {**WELL.publishers, "/joy": ["/joy_node", "/rosbag"]}
    nodes = {**WELL.nodes, "/rosbag": node("10.0.0.2", Answer.REFUSED)}
    facts = replace(WELL, publishers=publishers, nodes=nodes)
    wrong(facts, "/rosbag at http://10.0.0.2:1234/ is registered, but has died")
    assert any(
        f"/joy_node -> /joy -> /joy2twist -> {TELEOP}" in line for line in lines(facts, "ok")
    )
    nodes["/rosbag"] = node("10.0.0.2")
    wrong(replace(facts, nodes=nodes), "/joy is sent by /joy_node, /rosbag at once")


def test_no_joystick_message_comes_from_a_dead_node():
    facts = replace(with_node("/joy_node", node("10.0.0.2", Answer.REFUSED)), joysticks=[])
    assert not any("messages come from" in line for line in lines(facts, "ok"))


def test_of_the_robots_of_a_classroom_the_first_are_named_in_natural_order():
    robots = [f"/robot_{number}/cmd_vel" for number in range(1, 31)]
    subscribers = {"/joy": ["/joy2twist"], **{robot: ["/classroom"] for robot in robots}}
    facts = replace(
        WELL, subscribers=subscribers, types={**WELL.types, **dict.fromkeys(robots, TWIST)}
    )
    free = " or ".join(robots[:5])
    wrong(facts, f"start the robot, or drive the one at {free} and 25 more")
    assert len(lines(facts, "wrong")[0]) < 250


@pytest.mark.parametrize(
    ("names", "shown"),
    [
        (["b_10", "b_2", "a"], "a, b_2, b_10"),
        (["6", "5", "4", "3", "2", "1"], "1, 2, 3, 4, 5, 6"),  # "and 1 more" would be no shorter
        (list("gfedcba"), "a, b, c, d, e and 2 more"),
        ([], ""),
    ],
)
def test_names_in_a_line(names, shown):
    assert some(names) == shown


def test_a_gamepad_out_of_reach_is_told_from_one_that_nobody_touches():
    facts = replace(WELL, silent_s={"/joy_node": 12.3})
    assert lines(facts, "wrong") == []
    still = "stopped: the joystick has not changed for 3 s, it may be out of range; release"
    facts = replace(facts, states={"/joy2twist": (False, still)})
    seen = "the gamepad of /joy_node has been silent for 12 s: look at its battery"
    assert seen in lines(facts, "wrong")[-1]
