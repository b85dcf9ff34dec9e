"""Who drives, of what a launch file starts."""

import contextlib

import pytest

from tutorial_check.exercises import launch_nodes
from tutorial_check.exercises.driving import PACKAGE
from tutorial_check.exercises.launch_files import BAG, LaunchFile
from tutorial_check.model import Wrong

LISTENS = 'rospy.Subscriber("/joy", Joy, callback)\n'
DRIVES = f"{LISTENS}rospy.Publisher('/cmd_vel', Twist)\n"
SHOWS = f"{LISTENS}rospy.Publisher('/shown', String)\n"


def node(kind, name="second", **more):
    """One of the student's package, as launch_facts has it."""
    about = {"package": PACKAGE, "type": kind, "name": name, "namespace": "/", "args": ""}
    return {**about, "remaps": [], **more}


FIRST = node("joy2twist.py", "first")


@pytest.fixture
def session(make_session):
    """One with three programs, and a launch file."""
    session = make_session(PACKAGE, "5")
    texts = {"joy2twist.py": DRIVES, "class.py": DRIVES, "first.py": LISTENS, "shows.py": SHOWS}
    for name, text in texts.items():
        (session.package(PACKAGE).folder / name).write_text(text)
    text = '<launch>\n<node name="first"/>\n<node name="second"/>\n</launch>'
    (session.package(PACKAGE).folder / BAG).write_text(text)
    return session


@pytest.fixture
def given(session):
    """given(*nodes, text): the LaunchFile of that text, which starts these."""

    def make(*nodes, text=""):
        if text:
            (session.package(PACKAGE).folder / BAG).write_text(text)
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
def test_one_drives(given, other):
    launch_nodes.check_one_driver(given(FIRST, other))


@pytest.mark.parametrize(
    ("to", "own", "seen"),
    [
        ("/joystick", [], "joy_node sends them on /joystick"),
        ("/joystick", [["/joy", "/joystick"]], ""),
        ("joy", [], ""),
        ("joy", [["joy", "joystick"]], "joy2twist.py listens to /joystick"),
    ],
)
def test_where_the_joys_go(given, to, own, seen):
    joystick = {**node("joy_node", remaps=[["/joy", to]]), "package": "joy"}
    text = f"<launch>\n<remap from='joy' to='{own[0][1] if to == 'joy' and own else to}'/>"
    file = given(node("joy2twist.py", remaps=own), joystick, text=text)
    with pytest.raises(Wrong, match=seen) if seen else contextlib.nullcontext() as caught:
        launch_nodes.check_joy(file, joystick)
    assert not seen or caught.value.where == f"{BAG}:2"
