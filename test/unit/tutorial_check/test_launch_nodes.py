"""Who drives, of what a launch file starts."""

import pytest

from tutorial_check.exercises import launch_nodes
from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.exercises.launch_files import BAG, LaunchFile
from tutorial_check.model import Wrong

LISTENS = 'rospy.Subscriber("/joy", Joy, callback)\n'
DRIVES = f"{LISTENS}rospy.Publisher('/cmd_vel', Twist)\n"
SHOWS = f"{LISTENS}rospy.Publisher('/shown', String)\n"
TEXTS = {"joy2twist.py": DRIVES, "class.py": DRIVES, "first.py": LISTENS, "shows.py": SHOWS}


def node(kind, name="second", **more):
    """One of the student's package, as launch_facts has it."""
    about = {"package": PACKAGE, "type": kind, "name": name, "namespace": "/", "args": ""}
    return {**about, "remaps": [], **more}


@pytest.fixture
def launched(make_session):
    """launched(*nodes): a LaunchFile that starts these, of a package with some programs."""
    session = make_session(PACKAGE, "5")
    for name, text in {**TEXTS, BAG: "<launch/>"}.items():
        (session.package(PACKAGE).folder / name).write_text(text)

    def make(*nodes):
        session.memo("launch facts", dict)[BAG] = {"nodes": nodes}
        return LaunchFile(session, BAG)

    return make


@pytest.mark.parametrize(
    "other",
    [
        node("first.py"),  # the handout's first version
        node("class.py", remaps=[["/cmd_vel", "/elsewhere"]]),
        node("shows.py"),
        node("class.py", args="cmd_vel:=/elsewhere"),
        node("class.py", namespace="/robot2/"),
        node("made_of.cpp"),
    ],
)
def test_a_program_that_drives_nothing_is_no_second_driver(launched, other):
    launch_nodes.check_one_driver(launched(node("joy2twist.py", "first"), other))


def test_a_second_driver_is_wrong(launched):
    with pytest.raises(Wrong, match=r"2, joy2twist\.py and class\.py: all would"):
        launch_nodes.check_one_driver(launched(node("joy2twist.py", "first"), node("class.py")))
