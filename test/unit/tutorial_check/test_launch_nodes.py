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
    ("to", "own", "is_right"),
    [
        ("/joystick", [], False),
        ("/joystick", [["/joy", "/joystick"]], True),
        ("joy", [], True),
    ],
)
def test_where_the_joys_go(given, to, own, is_right):
    joystick = {**node("joy_node", remaps=[["/joy", to]]), "package": "joy"}
    text = "<launch>\n<remap from='joy' to='/joystick'/>"
    file = given(node("joy2twist.py", remaps=own), joystick, text=text)
    wrong = pytest.raises(Wrong, match="joy_node sends them on /joystick")
    with contextlib.nullcontext() if is_right else wrong as caught:
        launch_nodes.check_joy(file, joystick)
    assert is_right or caught.value.where == f"{BAG}:2"
