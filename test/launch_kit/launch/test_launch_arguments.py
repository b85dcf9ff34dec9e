"""A mistake in any argument of any launch file is one line, and starts nothing."""

from xml.etree import ElementTree

import pytest
import rosbag
import rospy
from sensor_msgs.msg import Joy

from launch_kit.arguments import FIXED, RULES
from launch_kit.ros.launch_tree import CALL, checked
from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY, Program, free_port
from tutorial_testing.waiting import wait_for

OURS = [
    file
    for folder in ("*", "common/*", "common/stand_ins/*")
    for pattern in ("*.launch", "**/*.launch.xml")
    for file in sorted(REPOSITORY.glob(f"{folder}/launch/{pattern}"))
    if "beginner_tutorials" not in file.parts  # it has the handout's shape, and no arguments
]
NOT_USED = "an argument of the real robot's file, without a use here"
# Arguments without a rule, and the reason.
FREE = dict.fromkeys(
    ("depth_registration", "rgb_processing", "ir_processing", "depth_processing",
     "depth_registered_processing", "disparity_processing", "disparity_registered_processing",
     "num_worker_threads", *FIXED),
    NOT_USED,
)  # fmt: skip
WRONG = "no such!"  # neither a number nor a name, nor a file


def arguments(file):
    """Return the names of the arguments that a user can give."""
    tags = ElementTree.parse(file).getroot().findall("arg")
    return [tag.get("name") for tag in tags if tag.get("value") is None]


def words_for(file, argument):
    """Return the words of a command line with one wrong argument; student.launch needs a name."""
    needed = ["name:=robot_7"] * (file.name == "student.launch" and argument != "name")
    return [*needed, f"{argument}:={WRONG}"]


def name_of(file):
    return str(file.relative_to(REPOSITORY))


@pytest.fixture
def master_uri(monkeypatch):
    uri = f"http://localhost:{free_port()}"
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    return uri


def check_refused(line, *words):
    """roslaunch prints a line of ours, and starts nothing, not even a master."""
    with Program("roslaunch", *map(str, words)) as program:
        assert program.wait() == 1, program.output
        ours = [text for text in program.output.splitlines() if text.startswith("roslaunch: ")]
        assert len(ours) == 1 and ours[0].startswith(f"roslaunch: {line}"), program.output
        assert "process[" not in program.output and not program.left_behind()


def test_no_rule_is_of_an_argument_that_no_file_has():
    assert {*RULES, *FREE} == {argument for file in OURS for argument in arguments(file)}


@pytest.mark.parametrize("file", OURS, ids=name_of)
def test_every_launch_file_calls_the_check_before_all_else(file):
    assert ElementTree.parse(file).getroot()[0].get("command") == CALL


@claim("Each argument of each launch file has a rule, and a value that breaks it is one line")
@pytest.mark.parametrize(
    ("file", "argument"),
    [(file, argument) for file in OURS for argument in arguments(file)],
    ids=lambda part: part if isinstance(part, str) else name_of(part),
)
def test_each_argument_of_each_launch_file_has_a_rule(file, argument):
    words = words_for(file, argument)
    if argument in FREE:
        checked(str(file), words)
    else:
        with pytest.raises(ValueError, match=f"^{argument}:={WRONG}: [^\n]*$"):
            checked(str(file), words)


@pytest.mark.parametrize("file", [file for file in OURS if arguments(file)], ids=name_of)
def test_a_wrong_argument_of_a_launch_file_starts_nothing(master_uri, file):
    named = [argument for argument in arguments(file) if argument not in FREE]
    if named:
        check_refused(f"{named[-1]}:={WRONG}: ", file, *words_for(file, named[-1]))


@claim("A mistake in a launch argument, such as a recording without a joystick, starts nothing")
@pytest.mark.parametrize(
    ("file", "arguments", "line"),
    [
        ("cockpit classroom.launch", "lan:=yes", "must be true or false"),
        ("joy2twist launch_bag.launch", "rviz:=yes", "must be true or false"),
        ("joy2twist launch_joy_node.launch", "virtual:=yes", "must be true or false"),
        ("joy2twist launch_joy_node_realTurtlebot.launch", "virtual:=yes", "must be true or false"),
        ("joy2twist student.launch", "name:=", "is missing: which robot of the classroom"),
        ("joy2twist student.launch", "name:=ada bag:=/no/joy.bag", "cannot be read"),
        ("joy2twist launch_joy_node_realTurtlebot.launch", "rviz:=false bag:={}/sparse.bag",
         "LB (button 4) or RB (button 5), the dead-man button of"),
    ],
)  # fmt: skip
def test_a_mistake_in_an_argument_starts_nothing(master_uri, tmp_path, file, arguments, line):
    with rosbag.Bag(str(tmp_path / "sparse.bag"), "w") as bag:
        bag.write("/joy", Joy(axes=[0.0, 1.0], buttons=[0] * 12), rospy.Time(1))
    words = arguments.format(tmp_path).split()
    check_refused(f"{words[-1]}: {line}", *file.split(), *words)


def test_a_mistake_in_a_students_own_launch_file_that_includes_ours_starts_nothing(
    master_uri, tmp_path
):
    file = "$(find rbx1_bringup)/launch/fake_turtlebot.launch"
    node = '<node pkg="rospy" type="none" name="mine"/>'
    (tmp_path / "mine.launch").write_text(
        f'<launch>{node}<include file="{file}"><arg name="world" value="rom"/></include></launch>'
    )
    check_refused("world:=rom: no world of this package", tmp_path / "mine.launch")


def test_what_is_ignored_is_reported_once(master_uri):
    words = ("turtlebot_bringup", "minimal.launch", "wrold:=room", "base:=create")
    with Program("roslaunch", *words) as program:
        wait_for(lambda: "started roslaunch server" in program.output, "roslaunch")
        ours = [text for text in program.output.splitlines() if text.startswith("roslaunch: ")]
    assert [line.split(":=")[0] for line in ours] == ["roslaunch: wrold", "roslaunch: base"]
