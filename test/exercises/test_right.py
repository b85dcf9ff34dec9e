"""Right solutions, the suite's, a literal one and many variants: nothing is called wrong."""

import os
import shutil
import subprocess

import pytest
import variants
from edits import *
from test_mistakes import is_reported

from tutorial_check.checking.checks import checks_of
from tutorial_check.checking.examination import examine
from tutorial_check.course.definition import read_course
from tutorial_check.report.text import lines_of
from tutorial_check.submission.order import Order
from tutorial_testing.processes import REPOSITORY

CHECKS = checks_of(read_course())
NOETIC = "/opt/ros/noetic/setup.bash"  # where ROS is not of Debian
LATE = "def made():\n    rospy.sleep(0.5)\n    return rospy.Publisher('/cmd_vel', Twist)\n\n\n"
PUB = "pub = rospy.Publisher('/cmd_vel', Twist)"
HEARD = 'I heard %s", data.data)'
INSTALL = "\ncatkin_install_python(PROGRAMS scripts/talker.py scripts/listener.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})"


def another(name, cmake, export=""):
    xml = f"<package><name>{name}</name><version>0.0.0</version><description>x</description><maintainer email='s@u.example'>s</maintainer><license>x</license><buildtool_depend>catkin</buildtool_depend>{export}</package>"
    text = f"cmake_minimum_required(VERSION 3.5)\nproject({name})\n{cmake}\n"
    return [write(f"{name}/package.xml", xml), write(f"{name}/CMakeLists.txt", text)]


LACKS = "find_package(catkin REQUIRED COMPONENTS diagnostic_nowhere)\ncatkin_package()"
FAILS = "find_package(catkin REQUIRED)\ncatkin_package()\nadd_executable(joy_node x.cpp)"
MAKES = "find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)\nadd_message_files(FILES Mine.msg)\ngenerate_messages(DEPENDENCIES std_msgs)\ncatkin_package()"
# What is right and worth a note: (what, edits, exercises, {check: words of the note; none: no note}).
NOTES = [
    ("a gap in a node's name", [put(LAUNCH_BAG, "my_rviz", "my rviz")], ["5"], {"C22": ("launch_bag.launch:2", 'name="my_rviz"')}),
    ("half as often, displayed twice, called like its file", [put(TALKER, "Rate(10)", "Rate(5)"), put(TALKER, "'talker'", "'talker.py'"), put(LISTENER, HEARD, f"{HEARD}\n    print(data.data)")], ["3"], {"C5": ("talker.py:8", "only: 'talker'"), "C6": ("the handout's is 10",), "C7": ("listener.py:8", "displayed 2 times")}),
    ("two Subscribers", [put(LISTENER, "    rospy.spin()", '    rospy.Subscriber("chatter", String, callback)\n    rospy.spin()')], ["3"], {"C6": (), "C7": ("listener.py:13", "displayed 2 times")}),
    ("half as fast, called like its file", [put(JOY2TWIST, "= data.axes[1]", "= 0.5*data.axes[1]"), put(JOY2TWIST, "'listener'", "'joy2twist.py'")], ["4.3"], {"C13": ("joy2twist.py:18", "only: 'joy2twist'"), "C16": ("linear.x = 0.50 * axes[1]",)}),
    ("loginfo_throttle", [put(JOY2TWIST, "rospy.loginfo(", "rospy.loginfo_throttle(1.0, ")], ["4.3"], {"C14": ("now and then", "joy2twist.py:9")}),
    ("two curves, the publisher first", [put(JOY2TWIST, "= data.axes[1]", "= data.axes[1] ** 3"), put(JOY2TWIST, "= data.axes[0]", "= data.axes[0] ** 3"), put(JOY2TWIST, f"{SUB}\n    {PUB}", f"{PUB}\n    {SUB}")], ["4.3"], {"C16": ("are curves of their axes",), "C18": ()}),
    ("the publisher made late, by a function above", [put(JOY2TWIST, PUB, "pub = made()"), put(JOY2TWIST, "def listener", f"{LATE}def listener")], ["4.3"], {"C18": ("joy2twist.py:24", "finds no pub")}),
    ("two Twists for a Joy", [put(JOY2TWIST, "pub.publish(msg)", "pub.publish(msg)\n    pub.publish(msg)")], ["4.3"], {"C16": ("joy2twist.py:14", "2 Twists for each Joy", "one is enough")}),
    ("a latch", [put(JOY2TWIST, "'/cmd_vel', Twist", "'/cmd_vel', Twist, latch=True")], ["4.3"], {"C16": ("latch=True", "leave latch out")}),
    ("the real joy, which cannot be built here, and scripts that catkin_install_python makes runnable", [*another("joy", LACKS), chmod(TALKER, 0o644), chmod(LISTENER, 0o644), put(f"{B}/CMakeLists.txt", "catkin_package()", f"catkin_package(){INSTALL}")], ["2", "3", "5"], {"C1": ("never built",), "C4": ("joy/CMakeLists.txt:3", "another package fails: catkin cannot find diagnostic_nowhere", "CATKIN_IGNORE"), "C5": (), "C25": ()}),
    ("the real joy, whose header is not here", [*another("joy", FAILS), write("joy/x.cpp", "#include <nowhere.h>\n")], ["2", "5"], {"C4": ("another package fails:", "nowhere.h"), "C26": ()}),
    ("the real kobuki_msgs", [*another("kobuki_msgs", MAKES), write("kobuki_msgs/msg/Mine.msg", "uint8 x\n")], ["2"], {"C1": ("never built",), "C4": ()}),
    ("a package of CMake alone", another("plain", "", "<export><build_type>cmake</build_type></export>"), ["2"], {"C4": ("another package fails: CMake: This workspace contains non-catkin packages in it, and",)}),
    ("a recording of another topic", [remove(f"{J}/bag/joy.bag"), chatter(f"{B}/chatter.bag")], ["4.2"], {"C11": (f"{B}/chatter.bag", "no recording of /joy; topics: /chatter")}),
    ("a devel folder from another home, in parts", [built("/nowhere", home="/home/ada/ws"), remove("../devel/_setup_util.py")], ["2"], {"C1": ("made elsewhere (/home/ada/ws/devel)",)}),
    ("built over a ROS in /opt/ros", [built("/opt/ros/noetic")], ["2"], {"C1": ("built over /opt/ros/noetic alone",)}),
    ("a devel folder from which git has left out setup.*", [built("/home/ada/ws/devel;/opt/ros/noetic"), remove("../devel/setup.sh"), remove("../devel/setup.bash")], ["2"], {"C1": ("has no setup.bash; built again here", "rm -r build devel"), "C4": ()}),
    (*variants.REPORTS, {"C29": (), "C33": ()}),
]  # fmt: skip


@pytest.fixture
def check(examined):
    """check(workspace, exercises): {id: result}; fails with what is called wrong."""

    def judge(workspace, exercises):
        outcomes = examined(workspace, exercises)
        assert [outcome.id for outcome in outcomes] == exercises
        results = [result for outcome in outcomes for result in outcome.results]
        assert not [lines_of(one) for one in results if one.status in ("wrong", "unreached")]
        return {result.id: result for result in results}

    return judge


def test_the_solutions_of_the_suite_are_right(tmp_path, check):
    for name in ("beginner_tutorials", "joy2twist"):
        shutil.copytree(REPOSITORY / name, tmp_path / "ws" / "src" / name)
    check(tmp_path / "ws", [*read_course().by_default, "7"])


def test_a_literal_solution_is_right_and_noted(literal, check):
    seen = check(literal.parent, read_course().by_default)
    assert seen.keys() == {one.id for one in CHECKS if one.exercise in read_course().by_default}
    # What the handout's own listings do is worth a word, no more.
    assert {seen[each].status for each in ("C18", "C20", "C29", "C32", "C33")} == {"note"}
    assert seen["C29"].where == "scripts/new_joy2twist.py:11"  # on_shutdown before the publisher


@pytest.mark.parametrize("row", NOTES, ids=lambda row: row[0])
def test_a_right_solution_is_noted(row, literal, check):
    _, edits, exercises, notes = row
    apply(edits, literal)
    found = check(literal.parent, exercises)
    for name, words in notes.items():
        assert found[name].status == ("note" if words else "ok")
        assert is_reported(found[name], words), lines_of(found[name])


@pytest.mark.parametrize(
    ("below", "status"), [("underlay", "ok"), ("nothing of the suite", "wrong")]
)
def test_below_what_a_workspace_was_built(literal, underlay, below, status):
    """As catkin writes its devel folder, over the suite or without it."""
    under = underlay if below == "underlay" else NOETIC
    build = f"[ ! -e '{under}' ] || . '{under}'; catkin_make"
    environment = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"]}
    subprocess.run(["bash", "-c", build], cwd=literal.parent, check=True, env=environment)
    (outcome,) = examine(Order(literal.parent, underlay, ["2"]))
    if status == "wrong" and Path(NOETIC).exists():
        status = "note"  # as a ROS in /opt/ros wants it
    assert next(one.status for one in outcome.results if one.id == "C1") == status


@pytest.mark.parametrize("row", variants.ROWS, ids=lambda row: row[0])
def test_a_variant_is_right(row, literal, check):
    _, edits, exercises = row
    apply(edits, literal)
    check(literal.parent, exercises)
