"""Who may drive, what stops a driver, and what pages are sent about it."""

from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from cockpit_server.access import DRIVER, VIEWER
from cockpit_server.driving.joy2twist_reports import DEADMAN, SILENT, Joy2TwistReports
from cockpit_server.driving.player import Player
from cockpit_server.driving.reasons import NO_ROBOT, TURTLES, About, Report, sentence
from cockpit_server.driving.who_drives import CONNECT_S, Driving
from cockpit_server.errors import RefusedError
from cockpit_server.graph import JOY, POSE, Graph
from cockpit_server.pages import LOOKS_ONLY
from tutorial_testing.claims import claim
from tutorial_testing.session_room import ANNA, BOB, DRIVE, REST, Topics, look, page

ADA = {"robot": "ada", "mode": "D"}


class Made(Driving):
    """A Driving with the pages of Anna and Bob, the robot ada and its joy2twist."""

    def __init__(self, role=DRIVER):
        self.now, self.n = 100.0, 0
        self.published, self.outdated = [], []
        self.report, self.rival, self.is_connected = Report("armed", "", "4"), "", True
        self.anna, self.bob = page(role, ANNA, look="ada"), page(DRIVER, BOB, look="ada")
        self.graph = Graph(subscribers={"/ada/joy": {"/joy2twist"}}, types={"/ada/joy": JOY})
        joysticks = SimpleNamespace(
            send=lambda *message: self.published.append(message), advertise=lambda _: None,
            rival=lambda *_: self.rival, is_connected=lambda _: self.is_connected,
        )  # fmt: skip
        reports = SimpleNamespace(newest=lambda *_: self.report, outdate=self.outdated.append)
        pages = {ANNA: self.anna[0], BOB: self.bob[0]}
        super().__init__(pages, self, joysticks, reports, lambda *_: False)

    def hold(self, position):
        """Answer the next beat from Anna's page with this position."""
        client, sent = self.anna
        self.now += 0.1
        self.tick(self.now)
        self.beat(self.now)
        beat = sent[-1]["n"]
        axes, buttons = position
        self.on_input(client, self.now, n=beat, t=1e3 * self.now, beat=beat, pad=None,
                      axes=axes, buttons=buttons, source="keys")  # fmt: skip


@pytest.fixture
def driven():
    """A Driving in which Anna drives."""
    made = Made()
    made.on_drive(made.anna[0], made.now, **ADA)
    for position in (REST, DRIVE):
        made.hold(position)
    assert made.published.pop() == ("ada", *DRIVE)
    made.published.clear()
    return made


@claim("A page drives once joy2twist is connected")
@pytest.mark.parametrize(
    ("is_connected", "after_s", "drives"),
    [(False, CONNECT_S - 0.2, False), (True, 0.0, True), (False, CONNECT_S, True)],
)
def test_page_drives_once_all_subscribers_are_connected_or_after_a_while(
    is_connected, after_s, drives
):
    made = Made()
    made.is_connected = is_connected
    made.on_drive(made.anna[0], made.now, **ADA)
    made.now += after_s
    made.hold(REST)
    assert made.session.armed == drives


@claim("Stop of any page that may drive stops the driver")
def test_stop_of_another_page_stops_the_driver_and_a_viewers_does_nothing(driven):
    client, sent = driven.anna
    with pytest.raises(RefusedError, match=LOOKS_ONLY):
        driven.on_stop(page(VIEWER)[0], driven.now)
    assert driven.session.armed
    driven.on_stop(driven.bob[0], driven.now)
    assert (driven.published, driven.session.driver) == ([("ada", *REST)], ANNA)
    assert not driven.session.armed  # the driver must release all first
    assert "pressed Stop" in sent[-1]["text"]
    driven.on_stop(client, driven.now)
    assert driven.driven is None


@claim("Another node on the same joy takes precedence")
def test_another_joystick_frees_the_session(driven):
    driven.rival = "/player"
    driven.beat(driven.now)
    assert (driven.published, driven.driven) == ([("ada", *REST)], None)
    assert "rosnode kill /player" in driven.anna[1][-1]["text"]


@claim(
    "A viewer's page says why its buttons are grey; a refusal is said beforehand; while a node "
    "drives, or only turtles are running, the page says so and offers no Drive; where nothing can "
    "be reset, no Reset"
)
@pytest.mark.parametrize(
    ("role", "robot", "rival", "driver", "refusal"),
    [
        (DRIVER, "ada", "", None, ""),
        (DRIVER, "bob", "", None, "there is no robot 'bob'"),
        (VIEWER, "ada", "", None, LOOKS_ONLY),
        (DRIVER, "ada", "/player", None, "/player publishes the joystick topic of this robot"),
        (DRIVER, "ada", "", BOB, "another page drives"),
        (DRIVER, "ada", "/player", ANNA, ""),  # the page's own session
    ],
)
def test_page_is_told_beforehand_why_it_may_not_drive(role, robot, rival, driver, refusal):
    made = Made(role)
    if driver is not None:
        made.session.take(driver, "ada", 0.0)
    made.rival = rival
    said = made.refusal(made.anna[0], robot, 0.0)
    assert said.startswith(refusal) and bool(said) == bool(refusal)
    if refusal:
        with pytest.raises(RefusedError, match=refusal):
            made.on_drive(made.anna[0], 0.0, robot, "D")


@claim("A viewer's page ...", because="only turtles; no Reset")
@pytest.mark.parametrize(("nodes", "refusal"), [(set(), NO_ROBOT), ({"/sim"}, TURTLES)])
def test_without_a_robot_the_page_says_what_is_running_and_resets_none(nodes, refusal):
    made, at = Made(), "/turtle1/pose"
    made.graph = Graph(publishers={at: nodes}, services={"/reset": nodes}, types={at: POSE})
    said = look(made, made.anna)[0][-1]
    assert (said["refusal"], said["no_reset"]) == (sentence(refusal), sentence(About().no_reset))
    assert made.graph.why_no_reset("")  # Turtlesim's service resets turtles.


def test_pages_are_sent_each_change_of_the_driver(driven):
    def sessions():
        pages = look(driven, driven.anna, driven.bob)
        return [[message for message in sent if message["kind"] == "session"] for sent in pages]

    state = {"kind": "session", "driver": ANNA, "robot": "ada"}
    state.update(plays=False, topic="", armed=True)
    assert sessions() == [[{**state, "yours": True}], [{**state, "yours": False}]]
    assert sessions() == [[], []]
    driven.on_drive(driven.anna[0], driven.now, **ADA)  # again
    for position in (REST, DRIVE):
        driven.hold(position)
    assert [len(sent) for sent in sessions()] == [1, 1]


def playing(made, position=0.0, **about):
    """Let Anna's page play a recording of 3 s; return what ends its motion appends to."""
    ends, player = [], Player(3.0, 1.0, loop=False, position=position)
    made.play(made.anna[0], player, 0.0, **about)
    messages = [(n, made.published.append, n) for n in range(4)]
    player.load(messages, [lambda: ends.append(True)], 0.0)
    return ends


@pytest.mark.parametrize(("is_cut", "end_s"), [(False, 3.0), (True, 2.5)])
def test_a_recording_is_published_until_its_end_or_until_its_page_is_cut(is_cut, end_s):
    made = Made()
    client, _ = made.anna
    playing(made, 0.5, robot="ada")
    made.tick(2.0)
    assert made.published == [1, 2]
    client.is_cut = lambda: is_cut
    made.tick(end_s - 0.5)
    assert made.driven is None


ENDS = {
    "its end": lambda made: made.tick(3.0),
    "pause": lambda made: made.leave(made.anna[0]),
    "Stop": lambda made: made.on_stop(made.bob[0], 1.0),
    "loss of the page": lambda made: made.gone(made.anna[0]),
    "end of the cockpit": lambda made: made.session.end(),
    "another recording": lambda made: playing(made, topic="/odom"),
}


@claim("A recorded velocity that is played ends with zero, however it ends; nobody else drives")
@pytest.mark.parametrize("end", ENDS)
def test_a_recording_without_a_joystick_has_the_session_and_ends_its_motion_once(end):
    made = Made()
    ends = playing(made, topic="/bob/cmd_vel")
    bob = made.bob[0]
    for refused in (lambda: made.on_drive(bob, 0.0, **ADA), lambda: playing_by(made, bob)):
        with pytest.raises(RefusedError, match="another page drives"):
            refused()
    with pytest.raises(RefusedError, match=LOOKS_ONLY):
        playing_by(made, page(VIEWER)[0])
    made.tick(1.0)
    assert (made.driven, ends) == ("bob", [])
    who = look(made, made.bob)[0][-1]["who"]
    assert who.endswith("plays a recording, on /bob/cmd_vel.")
    assert not made.publishes(made.anna[0], "/bob/cmd_vel")  # by a form
    ENDS[end](made)
    made.tick(3.5)
    assert (made.driven, ends) == (None, [True])


def playing_by(made, page):
    made.play(page, Player(3.0, 1.0, loop=False), 0.0, topic="/odom")


@claim("Reset puts one ...", because="the refusal")
def test_robot_is_not_reset_while_another_drives_it():
    made = Made()
    made.report = Report("driving")
    made.graph.publishers["/ada/joy"] = {"/rosbag_play"}
    made.session.why, made.session.stopped = "hidden", "ada"
    look(made, made.anna)
    assert made.session.stopped is None  # the robot moves again
    with pytest.raises(RefusedError, match="/rosbag_play drives this robot: stop it"):
        made.must_rest(made.anna[0], "ada")
    made.session.take(BOB, "ada", 0.0)
    with pytest.raises(RefusedError, match="another page drives this robot"):
        made.must_rest(made.anna[0], "ada")
    with pytest.raises(RefusedError, match="another page drives: until"):
        made.must_be_free(made.anna[0])
    look(made, made.anna)
    made.session.leave(BOB)
    look(made, made.anna)
    assert made.outdated == ["ada"]  # joy2twist's report of driving is outdated


def test_reports_of_joy2twist_are_read_by_robot_and_outdated_once_its_driver_has_left():
    topics = Topics()
    reports = Joy2TwistReports(topics)
    status = [
        DiagnosticStatus(1, "myjoystick2twist: joystick", "driving", "", []),
        DiagnosticStatus(1, "robot_1/joy2twist: joystick", "stopped: not armed", "",
                         [KeyValue(DEADMAN, "4")]),
        DiagnosticStatus(1, "fake_turtlebot: simulation", "running", "", []),
    ]  # fmt: skip
    for message in (DiagnosticArray(status=status), b"bytes that are none: joystick"):
        topics.hear("/diagnostics", message, now := 100.0)
    assert reports.newest("", now) == Report("driving", "driving")
    assert reports.newest("robot_1", now) == Report("stopped", "stopped: not armed", "4")
    assert reports.newest("robot_2", now) is None
    for robot in ("", "robot_1"):
        reports.outdate(robot)
    states = [reports.newest(robot, now).state for robot in ("", "robot_1")]
    assert states == ["unknown", "stopped"]
    assert reports.newest("", now + 5.0) == SILENT
