"""One truth about who drives and why a robot stands: what pages say in each situation."""

from math import inf
from types import SimpleNamespace

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from cockpit_server import driving_status
from cockpit_server.access import DRIVER
from cockpit_server.clients import LOOKS_ONLY
from cockpit_server.driver_session import DriverSession, RefusedError
from cockpit_server.driving_status import About, DrivingStatus, sentence
from cockpit_server.graph import Graph
from cockpit_server.hub import Hub
from cockpit_server.sources.resets import Resets
from cockpit_server.sources.teleop import DEADMAN, Teleop
from tutorial_testing.session_room import Topics, look, page

ANNA, BOB = 1, 2
MOVING, ARMED, FREE = ({"state": s, "deadman": d} for s, d in
                       (("driving", "4"), ("armed", "4"), ("armed", "none")))  # fmt: skip
PLAYS = ("/rosbag_play",)
SEAT = About(driver=ANNA, name="Firefox", armed=True, said=ARMED)

WHO = {
    "nobody": (About(said=ARMED), "Nobody drives."),
    "this page": (SEAT, "You drive ada."),
    "another page": (SEAT._replace(driver=BOB), "Firefox drives ada."),
    "a recording of this page": (SEAT._replace(plays=True), "You play a recording to ada."),
    "a recording of another": (
        SEAT._replace(plays=True, driver=BOB), "Firefox plays a recording to ada."),
    "a recording of rosbag": (About(said=MOVING, senders=PLAYS), "/rosbag_play drives ada."),
    "a joystick at rest": (
        About(said=ARMED, senders=PLAYS),
        "Nobody drives. Publishers of its joystick topic: /rosbag_play."),
    "without diagnostics": (About(senders=PLAYS, moves=True), "/rosbag_play drives ada."),
    "no joystick": (About(moves=True),
        "No joystick drives ada, but it moves: the tab Graph shows what moves it."),
}  # fmt: skip


@pytest.mark.parametrize("case", WHO)
def test_who_drives(case):
    about, said = WHO[case]
    assert driving_status.who(about, "ada", ANNA) == said
    assert driving_status.who(about, "", ANNA) == said.replace("ada", "the robot")
    assert (driving_status.driver(about) == "") == said.startswith(("Nobody", "No joystick"))


UNHEARD = "No node subscribes to /ada/joy: nothing moves before you start joy2twist for ada."
BY_LB = "Hold LB (a thumb, a gamepad's button, the key Shift), then move the stick (or arrow keys)."
BY_77 = "Hold button 77 (a gamepad's button), then move the stick (or arrow keys)."
FREELY = "Move the stick (a thumb, a gamepad, the arrow keys)."
READY = {  # -> why it stands and what to do now; how it is driven, without "Esc: stop."
    "drives": (SEAT, "Hold LB, then move the stick.", BY_LB),
    "sits down": (SEAT._replace(armed=False), "Release LB and the stick first.", BY_LB),
    "was stopped": (SEAT._replace(armed=False, why="hidden"),
        "Stopped: hidden. Release LB and the stick, then hold LB again.", BY_LB),
    "no button": (SEAT._replace(said=FREE),
        "Move the stick: this robot needs no button held.", FREELY),
    "a button without a name": (SEAT._replace(said={"state": "armed", "deadman": "77"}),
        "Hold button 77, then move the stick.", BY_77),
    "plays": (SEAT._replace(plays=True), "", ""),
    "looks on": (About(), "", BY_LB),
    "another page drives": (SEAT._replace(driver=BOB), "", ""),
    "a node drives": (About(said=MOVING), "", ""),
    "it stopped": (About(said=ARMED, why="the network is down"),
        "Stopped: the network is down.", BY_LB),
    "without joy2twist": (SEAT._replace(is_heard=False, armed=False), UNHEARD, ""),
    "without joy2twist, stopped": (About(is_heard=False, why="it"), f"Stopped: it. {UNHEARD}", ""),
}  # fmt: skip


@pytest.mark.parametrize("case", READY)
def test_the_page_says_why_the_robot_stands_and_what_to_do(case):
    about, said, how = READY[case]
    assert driving_status.ready(about, "ada", ANNA, "") == said
    assert driving_status.how_to(about, ANNA, may_drive=True) == f"{how} Esc: stop." * bool(how)
    assert driving_status.how_to(about, ANNA, may_drive=False) == ""
    if about.driver is None:
        viewed = driving_status.ready(about, "ada", ANNA, LOOKS_ONLY)
        assert viewed == f"{said} {sentence(LOOKS_ONLY)}".strip()


class Room:
    """A session, a joy2twist that reports, a graph, and a page that looks at the robot ada."""

    refusal = Hub.refusal

    def __init__(self):
        self.outdated, self.report, self.senders = [], ARMED, ()
        self.page = self.client, self.sent = page(DRIVER, ANNA, look="ada")
        self.clients = {ANNA: self.client}
        self.session = DriverSession(lambda *_: None, lambda *_: None)
        self._pads = SimpleNamespace(rival=lambda *_: None)
        graphs = self._graphs = SimpleNamespace(
            graph=SimpleNamespace(robots=lambda: ["ada"]), joysticks=lambda _: self.senders,
            joystick_listeners=lambda _: {"/joy2twist"},
        )  # fmt: skip
        teleop = SimpleNamespace(newest=lambda _: self.report, outdate=self.outdated.append)
        self.drives = DrivingStatus(self, graphs, teleop, SimpleNamespace(moves=lambda *_: False))

    @property
    def driven(self):
        return self.session.robot if self.session.driver is not None else None

    def look(self):
        return look(self.drives, self.page)[0]


def test_robot_is_not_reset_while_another_drives_it():
    room = Room()
    graphs = SimpleNamespace(graph=Graph(services={"/ada/reset": {"/sim"}}))
    resets = Resets(room, graphs, room.drives)
    room.report, room.senders = MOVING, PLAYS
    room.session.why, room.session.stopped = "hidden", "ada"
    assert [len(room.look()) for _ in range(3)] == [1, 1, 0]  # the words, when they change
    assert room.session.stopped is None  # it stands no longer
    with pytest.raises(RefusedError, match="/rosbag_play drives this robot: stop it"):
        resets.on_reset(room.client, 0.0, "ada")
    room.session.take(BOB, "ada", 0.0)
    with pytest.raises(RefusedError, match="another page drives this robot"):
        resets.on_reset(room.client, 0.0, "ada")
    room.look()
    room.session.leave(BOB)
    room.look()
    assert room.outdated == ["ada"]  # that joy2twist was driving is no longer true


def test_reports_of_joy2twist_are_read_by_robot_and_outdated_once_its_driver_has_left():
    topics, one = Topics(), page(robots=True)
    teleop = Teleop(topics)
    status = [
        DiagnosticStatus(1, "myjoystick2twist: joystick", "driving", "", []),
        DiagnosticStatus(1, "robot_1/joy2twist: joystick", "stopped: not armed", "",
                         [KeyValue(DEADMAN, "4")]),
        DiagnosticStatus(1, "fake_turtlebot: simulation", "running", "", []),
    ]  # fmt: skip
    for message in (DiagnosticArray(status=status), b"bytes that are none: joystick"):
        topics.hear("/diagnostics", message)
    told = {"kind": "teleop", "level": 1}
    driving = {**told, "robot": "", "state": "driving", "why": "driving", "deadman": None}
    stopped = {"robot": "robot_1", "state": "stopped", "why": "stopped: not armed", "deadman": "4"}
    assert look(teleop, one) == [[driving, {**told, **stopped}]]
    teleop.outdate("")
    assert look(teleop, one)[0][0]["state"] == "unknown"
    assert {words["state"] for words in look(teleop, one, now=inf)[0]} == {"silent"}
