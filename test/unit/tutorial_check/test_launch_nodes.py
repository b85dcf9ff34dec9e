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
VIEWER = {**node("rviz"), "package": "rviz"}
ROBOT = {**node("fake_turtlebot.py"), "package": "fake_turtlebot_sim"}


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


def test_two_drive(given):
    file = given(FIRST, node("class.py"))
    with pytest.raises(Wrong, match=r"2, joy2twist\.py and class\.py: all would drive") as caught:
        launch_nodes.check_one_driver(file)
    assert caught.value.where == f"{BAG}:3"


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


def test_a_joystick_beside_the_recording(session, given, monkeypatch):
    recording = {**node("play"), "package": "rosbag", "args": f"{session.source}/joy.bag"}
    joystick = {**node("joy_node"), "package": "joy"}
    monkeypatch.setattr(launch_nodes, "check_recording", lambda *about: None)
    (session.source).mkdir(parents=True, exist_ok=True)
    (session.source / "joy.bag").write_text("")
    given(VIEWER, ROBOT, FIRST, recording)
    launch_nodes.bag_nodes(session)
    given(VIEWER, ROBOT, FIRST, recording, joystick)
    with pytest.raises(Wrong, match="it starts a joystick, too"):
        launch_nodes.bag_nodes(session)


@pytest.mark.parametrize("word", ["-loop", "\u2014clock"])
def test_an_option_with_one_dash(session, given, word):
    text = f'<launch>\n<node args="{word}"/>\n</launch>'
    given({**node("play"), "package": "rosbag", "args": f"{word} /a.bag"}, text=text)
    with pytest.raises(Wrong, match=f"{word}, which it does not") as caught:
        launch_nodes.bag_of(session)
    assert caught.value.where == f"{BAG}:2"
    assert caught.value.hint.endswith(f"--{word[1:]}")


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
