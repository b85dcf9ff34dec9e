"""C21 to C26: the launch files of section 5."""

import difflib
import json
import math
import os
import re
import shlex
from pathlib import Path

from tutorial_check.exercises.driving import CMD_VEL, JOY, PACKAGE
from tutorial_check.exercises.robot import ODOM, plug_in
from tutorial_check.launch_facts import MARK
from tutorial_check.model import CannotCheck, Note, Wrong
from tutorial_check.tracebacks import explain, first_traceback, last_lines

BAG, STICK = "launch_bag.launch", "launch_joy_node.launch"
TURTLEBOT, REAL = "joy2twist_turtlebot.launch", "launch_joy_node_realTurtlebot.launch"
ALL = (BAG, STICK, TURTLEBOT, REAL)
BAG_S = 1.6  # length of the recording that takes the place of the student's
START_S = 20.0  # for all nodes of a launch on a busy machine


def find_launch(session, name):
    """The path of a launch file in the student's package. Raises Wrong."""
    folder = session.package(PACKAGE).folder
    found = sorted(folder.rglob(name))
    if found:
        if found[0].parent.name != "launch":
            return found[0]
        return found[0]
    others = {
        path.name: path for path in sorted(session.source.rglob("*launch*")) if path.is_file()
    }
    near = [
        other for other in others if other.lower() == name.lower()
    ] or difflib.get_close_matches(name, [other for other in others if other not in ALL], 1, 0.85)
    if near:
        inside = os.path.relpath(others[near[0]], session.source)
        raise Wrong(
            f"{PACKAGE}/launch/{name}",
            f"a file {inside}",
            where=inside,
            hint=f"its name must be {name}, and its place {PACKAGE}/launch",
        )
    raise Wrong(
        f"{PACKAGE}/launch/{name}",
        "no such file in your package",
        where=f"{PACKAGE}/launch",
        hint=f"write it; `roslaunch {PACKAGE} {name}` that works all the same runs OURS",
    )


def facts(session, name):
    """launch_facts of a file; all four are read at once."""
    return session.memo("launch facts", lambda: _read(session)).get(name)


def _read(session):
    folder = session.package(PACKAGE).folder
    paths = {}
    for name in ALL:
        for path in sorted(folder.rglob(name))[:1]:
            paths[name] = str(path)
    if not paths:
        return {}
    source = Path(__file__).resolve().parents[2]
    environment = {**session.environment, "DISPLAY": ":99"}
    environment["PYTHONPATH"] = f"{source}:{environment.get('PYTHONPATH', '')}"
    program = session.box.start(
        ["/usr/bin/python3", "-m", "tutorial_check.launch_facts", *paths.values()], environment
    )
    ended = session.box.wait(lambda: program.ended, 15.0)
    session.box.end(program)
    if not ended:
        raise Wrong(
            "launch files that roslaunch can read",
            "reading them does not end",
            hint="roslaunch --nodes FILE",
        )
    found = {}
    for line in program.output.splitlines():
        if line.startswith(MARK):
            one = json.loads(line[len(MARK) :])
            found[Path(one["path"]).name] = one
    if set(found) != set(paths):
        raise CannotCheck(f"launch files cannot be read: {last_lines(program.output)}")
    return found


def _relative(session, path):
    return os.path.relpath(path, session.package(PACKAGE).folder)


def check_file(session, name):
    """It exists, parses, and every $(find) leads somewhere that may be. Raises Wrong."""
    path = find_launch(session, name)
    where = _relative(session, path)
    one = facts(session, name)
    text = path.read_text(errors="replace")
    if one["error"]:
        raise _parse_error(session, one["error"], where, text)
    unknown = re.findall(
        r"unrecognized tag (\S+)|[Uu]nknown (?:<\w+> )?attribute (\S+)",
        one["said"] + " ".join(one.get("errors", [])),
    )
    odd = [tag for tag in one["tags"] if tag not in _TAGS]
    if odd or unknown:
        word = odd[0] if odd else next(each for each in unknown[0] if each)
        line = _line(text, f"<{word}" if odd else word)
        raise Wrong(
            "tags and attributes that roslaunch knows",
            f"{word}: ignored by roslaunch",
            where=f"{where}:{line}",
            hint=f"lower case: <{word.lower()}>"
            if word.lower() in _TAGS
            else "look at its spelling",
        )
    for each in one["nodes"]:
        _check_node(session, each, where, text)
    _check_finds(session, path, where, text)
    return path


_TAGS = {
    "launch",
    "node",
    "include",
    "remap",
    "param",
    "rosparam",
    "arg",
    "group",
    "env",
    "machine",
    "test",
    "master",
}


def _line(text, word):
    for number, line in enumerate(text.splitlines(), 1):
        if word in line:
            return number
    return 1


def _parse_error(session, error, where, text):
    line = re.search(r"line (\d+)", error)
    place = f"{where}:{line[1]}" if line else where
    hint = "roslaunch --nodes FILE shows the same"
    missing = re.search(r"Resource not found: (\S+)|package \[?'?([\w-]+)", error)
    if (
        "mismatched tag" in error
        or "no element found" in error
        or "not well-formed" in error
        or "junk after" in error
        or "unclosed token" in error
    ):
        hint = "each <tag> needs its </tag> or />; the mistake is in the line named or in the one before"
        if any(quote in text for quote in "“”‘’"):
            hint = 'curly quotes came from the PDF: type " instead'
            place = f"{where}:{next(n for n, each in enumerate(text.splitlines(), 1) if any(q in each for q in '“”‘’'))}"
    elif missing:
        name = (missing[1] or missing[2]).rstrip(":.")
        hint = f"there is no package {name}: look at the spelling in $(find {name}) or pkg="
        place = f"{where}:{_line(text, name)}"
    elif "No such file" in error or "does not exist" in error or "cannot resolve" in error.lower():
        file = re.search(r"'([^']+)'|\[([^\]]+)\]", error)
        named = Path(next((each for each in file.groups() if each), "")).name if file else ""
        hint = 'an include needs the whole path: file="$(find PACKAGE)/launch/FILE"'
        place = f"{where}:{_line(text, named)}"
    elif "attribute" in error or "requires" in error:
        hint = 'a node has pkg=, type= and name=; an include has file="$(find PACKAGE)/launch/FILE"'
        tag = re.search(r"<(\w+)>", error)
        place = f"{where}:{_line(text, '<' + tag[1] if tag else '<node')}"
    elif "arg" in error:
        hint = 'each $(arg x) needs an <arg name="x" default="..."/>'
    return Wrong("a launch file that roslaunch can read", error[:250], where=place, hint=hint)


def _check_node(session, node, where, text):
    package, kind = node["package"], node["type"]
    place = f"{where}:{_line(text, kind)}"
    if package == PACKAGE:
        folder = session.package(PACKAGE).folder
        found = [path for path in folder.rglob(kind) if path.is_file()]
        if kind == "joy_node":
            raise Wrong(
                "joy_node of package joy",
                'pkg="joy2twist" has no joy_node: your package hides ours',
                where=place,
                hint='<node pkg="joy" type="joy_node" name="joy_node"/>',
            )
        if kind.endswith(".launch"):
            raise Wrong(
                "programs in <node>",
                f'type="{kind}"',
                where=place,
                hint=f'<include file="$(find {package})/launch/{kind}"/>',
            )
        if not found:
            near = difflib.get_close_matches(
                kind, [path.name for path in folder.rglob("*") if path.is_file()], 1, 0.7
            )
            raise Wrong(
                f"a program {kind} in {PACKAGE}",
                "Cannot locate node of type [" + kind + "]",
                where=place,
                hint=f'type="{near[0]}"' if near else "type is the name of the file, with .py",
            )
        if not any(path.stat().st_mode & 0o100 for path in found):
            raise Wrong(
                f"{kind} may be run", "it is not executable", where=place, hint=f"chmod +x {kind}"
            )
        return
    if kind.endswith(".launch"):
        raise Wrong(
            "programs in <node>",
            f'type="{kind}"',
            where=place,
            hint=f'<include file="$(find {package})/launch/{kind}"/>',
        )
    known = session.memo(("node", package, kind), lambda: _locate(session, package, kind))
    if not known:
        hint = (
            "look at pkg= and type=: rosrun PACKAGE and twice Tab lists the programs of a package"
        )
        if kind == "joy_node":
            hint = '<node pkg="joy" type="joy_node" name="joy_node"/>'
        raise Wrong(
            "nodes that exist",
            f"Cannot locate node of type [{kind}] in package [{package}]",
            where=place,
            hint=hint,
        )


def _locate(session, package, kind):
    if package == "rviz" and kind == "rviz":
        return True
    code = "import sys, roslib.packages as p\ntry: sys.exit(not p.find_node(*sys.argv[1:]))\nexcept Exception: sys.exit(1)"
    found = session.box.start(["/usr/bin/python3", "-c", code, package, kind], session.environment)
    session.box.wait(lambda: found.ended, 10.0)
    session.box.end(found)
    return found.process.returncode == 0


def _check_finds(session, path, where, text):
    """No $(find joy2twist) leads to a file that the student does not have."""
    folder = session.package(PACKAGE).folder
    for number, line in enumerate(text.splitlines(), 1):
        for rest in re.findall(rf"\$\(find\s+{PACKAGE}\)([^\s\"'<>$]*)", line):
            if rest.strip("/") and not (folder / rest.strip("/")).exists():
                note = (
                    "mkdir bag, and copy joy.bag into it"
                    if rest.endswith(".bag")
                    else f"write {Path(rest).name} in YOUR package"
                )
                raise Wrong(
                    f"$(find {PACKAGE}){rest} in your package",
                    "no such file there",
                    where=f"{where}:{number}",
                    hint=f"{note}; another workspace's file would be taken without a word",
                )


def files(session):
    """C21: the two launch files of section 5."""
    return ", ".join(_relative(session, check_file(session, name)) for name in (BAG, STICK))


# ------------------------------------------------------------------------------------ the nodes


def nodes_of(session, name):
    """Those of a launch file, as launch_facts has them."""
    return facts(session, name)["nodes"]


def is_viewer(node):
    """Whether RViz, or what starts it."""
    return node["type"] in ("rviz", "view_robot")


def is_simulator(node):
    """Whether the simulated robot."""
    return (
        node["package"] == "fake_turtlebot_sim" and node["type"] == "fake_turtlebot.py"
    ) or node["package"].startswith("arbotix")


def is_player(node):
    """Whether it plays a recording."""
    return (node["package"], node["type"]) == ("rosbag", "play")


def is_joystick(node):
    """Whether a driver of joysticks."""
    return (
        node["type"] in ("joy_node", "joy_node.py", "joystick.py") and node["package"] != "rosbag"
    )


def is_own(node):
    """Whether the student's joy2twist."""
    return node["package"] == PACKAGE


def demand(session, name, what, test, hint):
    """The node of a launch file of which test() is true, or Wrong."""
    path = find_launch(session, name)
    found = [node for node in nodes_of(session, name) if test(node)]
    if not found:
        raise Wrong(
            f"{name} starts {what}", "it does not", where=_relative(session, path), hint=hint
        )
    return found[0]


def check_viewer(session, name):
    """RViz with a configuration that exists."""
    node = demand(
        session,
        name,
        "RViz",
        is_viewer,
        '<node pkg="rviz" type="rviz" name="my_rviz" args="-d $(find rbx1_nav)/sim.rviz"/>',
    )
    words = shlex.split(node["args"])
    config = next(
        (words[i + 1] for i, word in enumerate(words[:-1]) if word in ("-d", "--display-config")),
        None,
    )
    where = f"{_relative(session, find_launch(session, name))}:{_line(find_launch(session, name).read_text(errors='replace'), 'rviz')}"
    if config and config != "auto" and not Path(config).exists():
        raise Wrong(
            "-d FILE names a file that exists",
            f"no file {config}",
            where=where,
            hint="-d $(find rbx1_nav)/sim.rviz",
        )
    if not config and node["type"] == "rviz":
        return Note(
            "RViz opens without -d FILE: its view is the last one used",
            where,
            "-d $(find rbx1_nav)/sim.rviz",
        )
    return None


ROBOT_HINT = '<include file="$(find rbx1_bringup)/launch/fake_turtlebot.launch"/>'
OWN_HINT = '<node pkg="joy2twist" type="joy2twist.py" name="myjoystick2twist"/>'
BAG_HINT = (
    '<node pkg="rosbag" type="play" name="rosbag" args="--loop $(find joy2twist)/bag/joy.bag"/>'
)
JOY_HINT = '<node pkg="joy" type="joy_node" name="joy_node"/>'


def bag_of(session):
    """The recording that launch_bag plays: its path."""
    node = demand(session, BAG, "rosbag play", is_player, BAG_HINT)
    path = find_launch(session, BAG)
    where = f"{_relative(session, path)}:{_line(path.read_text(errors='replace'), 'play')}"
    words = [word for word in shlex.split(node["args"]) if not word.startswith("_")]
    bags = [word for word in words if word.endswith(".bag")]
    if not bags:
        raise Wrong(
            "rosbag play with the recording",
            f"args: {node['args'] or 'none'}",
            where=where,
            hint=BAG_HINT,
        )
    if not os.path.isabs(bags[0]):
        raise Wrong(
            "a whole path to the recording",
            bags[0],
            where=where,
            hint=f"roslaunch starts rosbag in a folder of its own: $(find joy2twist)/bag/{Path(bags[0]).name}",
        )
    if not Path(bags[0]).exists() and str(session.layout.root) not in bags[0]:
        raise Wrong(
            "a recording that exists",
            f"no file {bags[0]}",
            where=where,
            hint="mkdir bag in your package, and copy joy.bag into it",
        )
    return bags[0], where


def bag_nodes(session):
    """C22."""
    note = check_viewer(session, BAG)
    demand(session, BAG, "the simulated robot", is_simulator, ROBOT_HINT)
    demand(session, BAG, "joy2twist", is_own, OWN_HINT)
    bag, where = bag_of(session)
    if not bag.startswith(str(session.source)):
        if (
            not Path(bag).exists()
            or "$(find"
            not in find_launch(session, BAG).read_text(errors="replace").split("play", 1)[-1]
        ):
            return Note(
                f"the recording is not in your package: {bag}",
                where,
                "$(find joy2twist)/bag/joy.bag goes wherever the package goes",
            )
        return Note(f"the recording is not in your package: {bag}", where)
    return note


def stick_nodes(session):
    """C25."""
    note = check_viewer(session, STICK)
    demand(session, STICK, "the simulated robot", is_simulator, ROBOT_HINT)
    demand(session, STICK, "joy2twist", is_own, OWN_HINT)
    demand(session, STICK, "joy_node", is_joystick, JOY_HINT)
    if any(is_player(node) for node in nodes_of(session, STICK)):
        raise Wrong(
            "a joystick only",
            "it plays a recording, too: both would drive",
            where=f"launch/{STICK}",
            hint="take the rosbag node out",
        )
    return note


# ------------------------------------------------------------------------------------ the drive


class Launch:
    """A launch file run on a stage, and what flowed."""

    def __init__(self, session, name, stage, twists=CMD_VEL):
        """twists: the topic on which the velocities should come."""
        self.session, self.stage, self.name, self.twists = session, stage, name, twists
        for topic, kind in ((JOY, "Joy"), (twists, "Twist"), (ODOM, "Odometry")):
            stage.call("listen", topic, kind)
        self.program = stage.launch(["roslaunch", str(find_launch(session, name))])

    def moved(self):
        """How far the robot drove [m], along its way."""
        path = [value for _, _, value in self.stage.call("heard", ODOM)]
        return sum(math.hypot(b[1] - a[1], b[2] - a[2]) for a, b in zip(path, path[1:]))

    def wrong(self, expected):
        """The Wrong for a launch that does not do what it should, with the first cause there is."""
        output = re.sub(r"\x1b\[[0-9;]*m|\x1b\][^\x07]*\x07", "", self.program.output)
        trace = first_traceback(output, str(self.session.package(PACKAGE).folder))
        if trace:
            return Wrong(expected, trace.error, where=trace.where, hint=explain(trace.error))
        counts = {topic: self.stage.call("count", topic) for topic in (JOY, self.twists, ODOM)}
        silent = [topic for topic, count in counts.items() if not count]
        errors = [
            line
            for line in output.splitlines()
            if re.search(r"ERROR|died|Invalid|cannot|Unable", line)
            and "rviz" not in line
            and "INFO" not in line
        ]
        errors = errors or [
            line for log in self._logs() for line in log.splitlines()[-1:] if "INFO" not in line
        ]
        seen = (
            f"nothing on {', '.join(silent)}" if silent else f"the robot moved {self.moved():.2f} m"
        )
        if errors:
            seen += f"; {errors[0].strip()[:200]}"
        return Wrong(
            expected, seen, where=f"launch/{self.name}", hint=_silence_hint(silent, self.twists)
        )

    def _logs(self):
        """What nodes without output="screen" wrote."""
        folder = Path(self.stage.environment["ROS_LOG_DIR"])
        for path in sorted(folder.rglob("*-stdout.log")):
            yield path.read_text(errors="replace")[-3000:]


def _silence_hint(silent, twists):
    if JOY in silent:
        return "does the recording, or joy_node, run? rostopic hz /joy"
    if twists in silent:
        return f"does joy2twist run, and publish on {twists}? rosnode list"
    if ODOM in silent:
        return "does the simulated robot run? " + ROBOT_HINT
    return "rostopic echo /cmd_vel"


def _own_bag(session, path):
    """A short recording in place of the student's: rest with LB released, then forwards."""
    import rosbag  # noqa: PLC0415
    import rospy  # noqa: PLC0415
    from sensor_msgs.msg import Joy  # noqa: PLC0415

    mode = os.stat(path).st_mode
    os.unlink(path)
    with rosbag.Bag(str(path), "w") as bag:
        for k in range(int(BAG_S * 20)):
            stamp = rospy.Time(1_600_000_000 + k / 20)
            joy = Joy(
                axes=[0.0, 0.5 if k > 4 else 0.0, 0.0, 0.0, 0.0, 0.0],
                buttons=[0, 0, 0, 0, int(k > 4)] + [0] * 7,
            )
            joy.header.stamp = stamp
            bag.write("/joy", joy, stamp)
    os.chmod(path, mode | 0o444)


def _bag_run(session):
    bag, _ = bag_of(session)
    replaced = bag.startswith(str(session.source))
    if replaced:
        _own_bag(session, bag)
    with session.stage() as stage:
        launch = Launch(session, BAG, stage)
        enough = stage.wait(
            lambda: (
                launch.moved() > 0.3
                or (launch.program.ended and "roslaunch")
                or (_died(launch) and "died")
            ),
            START_S,
        )
        drives = enough is True
        wrong = (
            None
            if drives
            else launch.wrong("/joy, /cmd_vel and /odom flow, and the robot drives more than 0.3 m")
        )
        loops = False
        if drives:
            begun = stage.call("heard", JOY)[0][0]
            longest = BAG_S if replaced else 30.0

            def again():
                heard = stage.call("heard", JOY)
                return heard[-1][0] - begun > longest + 0.5 or any(
                    is_player(node) and node["respawn"] for node in nodes_of(session, BAG)
                )

            loops = bool(stage.wait(again, longest + 2.5)) if replaced else _loops_by_words(session)
        return wrong, drives, loops


def _died(launch):
    return any(
        "has died" in line and "rviz" not in line for line in launch.program.output.splitlines()
    )


def _loops_by_words(session):
    node = next(each for each in nodes_of(session, BAG) if is_player(each))
    return node["respawn"] or bool({"--loop", "-l"} & set(shlex.split(node["args"])))


def bag_drives(session):
    """C23."""
    wrong, _, _ = session.memo("bag run", lambda: _bag_run(session))
    if wrong:
        raise wrong


def bag_loops(session):
    """C24."""
    _, _, loops = session.memo("bag run", lambda: _bag_run(session))
    if not loops:
        raise Wrong(
            "/joy flows on after the end of the recording",
            "it falls silent",
            where=f"launch/{BAG}",
            hint="rosbag play --loop",
        )


def stick_drives(session):
    """C26."""
    check_stick(session, STICK)


def check_stick(session, name):
    """A launch file with a joystick: the robot moves with the stick."""
    with session.stage() as stage:
        pad = plug_in_for(session, stage, name)
        launch = Launch(session, name, stage)
        pushed = push_when_ready(stage, pad, launch)
        stage.wait(
            lambda: launch.moved() > 0.15 or launch.program.ended or _died(launch),
            4.0 if pushed else 0.0,
        )
        if launch.moved() <= 0.15:
            raise launch.wrong("the robot moves with the stick")
        pad.call("release")
        stage.wait(lambda: abs(stage.call("heard", ODOM)[-1][2][5]) < 0.01, 3.0)
        if abs(stage.call("heard", ODOM)[-1][2][5]) > 0.01:
            raise Wrong("released, the robot stands", "it drives on", where=f"launch/{name}")


def plug_in_for(session, stage, name):
    """A joystick where the joy_node of a launch file will look for it."""
    pad, path = plug_in(session, stage)
    if str(path) != "/dev/input/js0":
        for node in nodes_of(session, name):
            if is_joystick(node):
                stage.call("set_parameter", f"{node['namespace']}{node['name']}/dev", str(path))
    return pad


def push_when_ready(stage, pad, launch):
    """Push the stick forwards once everything runs; whether it came to that."""
    topics = (JOY, launch.twists, ODOM)

    def ready():
        return (
            pad.call("connected")
            and all(stage.call("speakers", topic) for topic in topics)
            and stage.call("count", JOY)
        )

    stage.wait(lambda: ready() or launch.program.ended or _died(launch), START_S)
    # A robot that has only just come obeys once it was told to rest for a while; so do we.
    stage.wait(lambda: launch.program.ended, 0.6)
    pad.call("push", 0.0, 0.6)
    return bool(ready())
