# ruff: noqa: SIM905  lists of names read better as texts
"""Imports go one way: scripts -> node -> messages, topics -> the rules; and only downwards.

Every module of every package stands below, so that a new one has to be given its place.
"""

import ast
import sysconfig
from importlib.util import find_spec
from pathlib import Path
from xml.etree import ElementTree

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
# Library -> (package that holds it, floor). The lower floor needs nothing of the upper one.
LIBRARIES = {
    "node_kit": ("common/node_kit", 0),
    "gamepad": ("common/gamepad", 0),
    "fake_turtlebot_sim": ("fake_turtlebot_sim", 0),
    "tutorial_tools": ("common/tutorial_tools", 0),
    "cockpit_server": ("common/cockpit", 0),
    "joy_to_twist": ("joy2twist", 1),
}
# Each module may import those that stand before it. The rules know neither ROS nor a clock.
RULES = """
node_kit.arguments node_kit.parameters node_kit.throttle node_kit.newest_only
node_kit.questions node_kit.names node_kit.page node_kit.states node_kit.resumption node_kit.arming
gamepad.js_event gamepad.gamepads gamepad.trembling
gamepad.driver.device_choice gamepad.driver.parameters gamepad.driver.schedule
gamepad.driver.state gamepad.driver.driver gamepad.driver.report gamepad.virtual.controls
gamepad.virtual.keyboard gamepad.virtual.moves
gamepad.virtual.sources fake_turtlebot_sim.simulator.differential_drive
fake_turtlebot_sim.simulator.velocity_command fake_turtlebot_sim.simulator.odometry_errors
fake_turtlebot_sim.simulator.clock fake_turtlebot_sim.simulator.simulated_robot
fake_turtlebot_sim.simulator.parameters fake_turtlebot_sim.mux.arbitration
fake_turtlebot_sim.mux.parameters gamepad.arguments
tutorial_tools.bag.picture tutorial_tools.demo.drive_report tutorial_tools.doctor.facts
tutorial_tools.doctor.judgement joy_to_twist.parameters joy_to_twist.limits joy_to_twist.mapping
joy_to_twist.gamepad_hints joy_to_twist.safety joy_to_twist.teleoperation
cockpit_server.access cockpit_server.schema cockpit_server.seat cockpit_server.player
cockpit_server.motion cockpit_server.fields cockpit_server.graph cockpit_server.admission
cockpit_server.budget cockpit_server.clients cockpit_server.drives cockpit_server.guard
""".split()
OUTER = """
node_kit.launch_check node_kit.launch_end node_kit.manifests node_kit.suspension
node_kit.careful_connections node_kit.ending node_kit.log node_kit.prompt_publisher node_kit.start
gamepad.driver.wake gamepad.driver.device gamepad.driver.node gamepad.virtual.terminal
gamepad.virtual.pads gamepad.virtual.program fake_turtlebot_sim.simulator.ros_messages
fake_turtlebot_sim.simulator.ros_clock fake_turtlebot_sim.simulator.robot_topics
fake_turtlebot_sim.simulator.diagnostics fake_turtlebot_sim.simulator.node
fake_turtlebot_sim.mux.node fake_turtlebot_sim.classroom_view.bodies
fake_turtlebot_sim.classroom_view.node fake_turtlebot_sim.replay.bag_replay
fake_turtlebot_sim.replay.command tutorial_tools.demo.in_the_way tutorial_tools.demo.launch
tutorial_tools.demo.program tutorial_tools.doctor.network tutorial_tools.doctor.collect
tutorial_tools.doctor.program tutorial_tools.graph.program tutorial_tools.bag.program
tutorial_tools.join.program
joy_to_twist.lean_joy
joy_to_twist.console joy_to_twist.node
cockpit_server.feeds cockpit_server.graph_watch cockpit_server.robots cockpit_server.joysticks
cockpit_server.teleop cockpit_server.resets cockpit_server.plots cockpit_server.graph_view
cockpit_server.logs cockpit_server.doctor cockpit_server.recording
cockpit_server.bags cockpit_server.hub cockpit_server.web cockpit_server.node
cockpit_server.program
""".split()
ALL = RULES + OUTER
ALLOWED_IN_RULES = set(
    """
    __future__ argparse bisect collections dataclasses difflib enum errno hmac html ipaddress
    itertools json
    math numpy os random re struct sys types typing
    """.split()
)
# What speaks to the other side of a socket, and waits for it, is handed the socket or the address.
SOCKETS = {"http.client", "select", "socket", "threading", "urllib.parse", "xmlrpc.client"}
MAY_USE_SOCKETS = {"node_kit.newest_only", "node_kit.questions", "node_kit.names"}
INSIDE_ROSPY = ("rospy.core", "rospy.client", "rospy.impl", "rospy.names")
# Import name -> the name in package.xml, where they differ.
NAMES_OF_PACKAGES = {
    "evdev": "python3-evdev", "matplotlib": "python3-matplotlib", "numpy": "python3-numpy",
    "rospkg": "python3-rospkg", "tornado": "python3-tornado", "tqdm": "python3-tqdm",
    "watchdog": "python3-watchdog", "yaml": "python3-yaml",
}  # fmt: skip
NOT_IN_DEBIAN = {"rosbags"}  # PyPI's, of which package.xml cannot speak


def path_of(module):
    library = module.split(".")[0]
    return REPOSITORY / LIBRARIES[library][0] / "src" / f"{module.replace('.', '/')}.py"


def scripts():
    folders = {package for package, _ in LIBRARIES.values()}
    paths = (path for folder in folders for path in (REPOSITORY / folder / "scripts").glob("*"))
    return sorted(path for path in paths if path.is_file())


def imported(path):
    """The full names of all modules that a file imports."""
    for statement in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(statement, ast.Import):
            yield from (alias.name for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom):
            for alias in statement.names:
                inside = f"{statement.module}.{alias.name}"
                yield inside if inside in ALL else statement.module


def test_every_module_has_its_place():
    found = {
        ".".join(path.relative_to(REPOSITORY / package / "src").with_suffix("").parts)
        for package, _ in LIBRARIES.values()
        for path in (REPOSITORY / package / "src").rglob("*.py")
        if path.name != "__init__.py"
    }
    assert found == set(ALL)
    assert len(ALL) == len(set(ALL))


@pytest.mark.parametrize("module", ALL)
def test_a_module_imports_only_what_stands_before_it(module):
    ours = {name for name in imported(path_of(module)) if name.split(".")[0] in LIBRARIES}
    assert ours <= set(ALL[: ALL.index(module)])
    floor = LIBRARIES[module.split(".")[0]][1]
    assert all(LIBRARIES[name.split(".")[0]][1] <= floor for name in ours)


@pytest.mark.parametrize("module", RULES)
def test_the_rules_know_neither_ros_nor_a_clock(module):
    others = {name for name in imported(path_of(module)) if name.split(".")[0] not in LIBRARIES}
    assert others <= ALLOWED_IN_RULES | (SOCKETS if module in MAY_USE_SOCKETS else set())


@pytest.mark.parametrize("path", [*map(path_of, ALL), *scripts()], ids=lambda path: path.name)
def test_only_the_kit_looks_inside_rospy(path):
    if "node_kit" in path.parts:
        return
    text = path.read_text(encoding="utf-8")
    assert not [name for name in imported(path) if name.startswith(INSIDE_ROSPY)]
    for part in ast.walk(ast.parse(text)):
        if isinstance(part, ast.Attribute):
            name = ast.get_source_segment(text, part)  # ast.unparse: Python 3.9
            assert not name.startswith((*INSIDE_ROSPY, "rospy._")), name
            assert not (name.endswith("._connection_header") or ".impl." in name), name


@pytest.mark.parametrize("path", scripts(), ids=lambda path: path.name)
def test_a_script_only_starts_its_program(path):
    if path.name in ("rqt_graph", "view_robot"):
        return  # they start another program, too
    ours = {name for name in imported(path) if name.split(".")[0] in LIBRARIES}
    assert len(ours) == 1
    assert len(path.read_text(encoding="utf-8").splitlines()) < 20


@pytest.mark.parametrize("library", LIBRARIES)
def test_what_is_imported_is_declared(library):
    folder = REPOSITORY / LIBRARIES[library][0]
    root = ElementTree.parse(folder / "package.xml").getroot()
    declared = {part.text for part in root if part.tag in ("depend", "exec_depend")}
    for module in [name for name in ALL if name.split(".")[0] == library]:
        for name in {name.split(".")[0] for name in imported(path_of(module))}:
            package = LIBRARIES[name][0].split("/")[-1] if name in LIBRARIES else name
            package = NAMES_OF_PACKAGES.get(package, package)
            known = name == library or package in declared
            assert known or is_of_python(name) or name in NOT_IN_DEBIAN, f"{module}: {name}"


def is_of_python(name):
    """Whether a module belongs to Python itself."""
    spec = find_spec(name)
    standard = sysconfig.get_paths()["stdlib"]
    origin = (spec and spec.origin) or ""
    return origin in ("built-in", "frozen") or (
        origin.startswith(standard) and "-packages" not in origin
    )


@pytest.mark.parametrize("module", ALL)
def test_a_file_is_read_in_five_minutes(module):
    assert len(path_of(module).read_text(encoding="utf-8").splitlines()) < 300
