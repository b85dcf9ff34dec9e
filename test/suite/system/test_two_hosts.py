"""The README's two machines, joined by a network, and what happens when its cable is pulled."""

from math import dist

from tutorial_testing.claims import claim
from tutorial_testing.two_hosts.scene import REPOSITORY, ROBOT, WORKSTATION
from tutorial_testing.waiting import tolerance, wait_for

TURTLEBOT = "roslaunch joy2twist joy2twist_turtlebot.launch log_rate:=50"
TIMEOUT_S = 0.6  # the base's


def ends_with(topic, text):
    """Return whether the last message that rostopic echo has printed contains the text."""
    return text in "".join(topic.output.split("---")[-2:])


@claim("The page's two machines drive; doctor and graph see both")
def test_the_readme_commands_drive_the_recording_across_and_the_tools_see_it(scene, tmp_path):
    scene.launch_robot()
    scene.launch_workstation()
    scene.first(lambda moment: dist(moment.pose[:2], (0, 0)) > 0.5, "robot that follows the bag")
    assert not scene.workstation.ended
    for host, other in ((WORKSTATION, ROBOT), (ROBOT, WORKSTATION)):
        doctor = scene.start(host, f"'{REPOSITORY}/tutorial' doctor")
        assert doctor.wait() == 0, doctor.output
        assert f"{scene.address(other)} is within 0.1 s" in doctor.output
        assert "-> /cmd_vel_mux/input/teleop -> /cmd_vel_mux\n" in doctor.output
        assert "/cmd_vel_mux lets /cmd_vel_mux/input/teleop through" in doctor.output
    graph = scene.start(WORKSTATION, f"rosrun tutorial_tools draw_graph.py {tmp_path}/graph.dot")
    assert graph.wait() == 0, graph.output
    drawn = (tmp_path / "graph.dot").read_text()
    for host in (WORKSTATION, ROBOT):
        assert f'subgraph "cluster {scene.address(host)}"' in drawn


@claim("A pulled cable stops the robot; late commands do not move it; neutral lets it drive again")
def test_a_pulled_cable_stops_the_robot_which_drives_again_after_neutral(scene):
    scene.launch_robot()
    scene.launch_workstation(TURTLEBOT)
    active = scene.start(ROBOT, "rostopic echo /cmd_vel_mux/active")
    scene.launch_pilot()
    wait_for(lambda: "axis 1 -> linear.x" in scene.workstation.output, "joy2twist")
    scene.tell("neutral")
    wait_for(lambda: "Get from Joy" in scene.workstation.output, "joystick heard")
    scene.drive()

    before, late_s = scene.odometry[-1], tolerance()
    scene.network.pull_cable(WORKSTATION)
    pulled = scene.odometry[-1]
    stands = scene.first(lambda m: m.stamp > before.stamp and m.v == 0, "robot that stands")
    assert stands.stamp - pulled.stamp <= TIMEOUT_S + 0.02 + late_s()
    # Not a stop that came across, or there was no cut: the coast of the timeout.
    assert dist(stands.pose[:2], before.pose[:2]) >= 0.9 * TIMEOUT_S * before.v
    wait_for(lambda: "is cut" in scene.workstation.output, "warning of joy2twist")

    # LB and the stick are held all the time, and what was sent meanwhile comes now.
    wait_for(lambda: ends_with(active, "idle"), "robot that nobody drives")
    scene.network.plug_cable(WORKSTATION)
    wait_for(lambda: ends_with(active, "teleop"), "late commands")
    scene.more()
    assert {m.pose[:2] for m in scene.since(stands.stamp)} == {stands.pose[:2]}

    # Neutral once, and it drives as before, with no program restarted.
    scene.tell("neutral")
    wait_for(lambda: "is back" in scene.workstation.output, "word of joy2twist")
    wait_for(lambda: ends_with(active, "idle"), "robot that nobody drives")
    assert scene.drive().v == before.v
    for program in (scene.robot, scene.workstation):
        assert "has died" not in program.output
        assert "restarting" not in program.output
