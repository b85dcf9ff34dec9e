"""Who drives, and why a robot stands: what pages say in each situation."""

import pytest

from cockpit_server.driving import reasons
from cockpit_server.driving.reasons import About, Report, sentence
from cockpit_server.pages import LOOKS_ONLY
from tutorial_testing.claims import claim
from tutorial_testing.session_room import ANNA, BOB

pytestmark = claim("Who drives, and why the robot stands, in one set of words")
MOVING, ARMED, FREE = Report("driving"), Report("armed", "", "4"), Report("armed", "", "none")
PLAYS = ("/rosbag_play",)
SEAT = About(driver=ANNA, name="Firefox", armed=True, report=ARMED)

WHO = {
    "nobody": (About(report=ARMED), "Nobody drives."),
    "this page": (SEAT, "You drive ada."),
    "another page": (SEAT._replace(driver=BOB), "Firefox drives ada."),
    "a recording of this page": (SEAT._replace(plays=True), "You play a recording to ada."),
    "a recording of another": (
        SEAT._replace(plays=True, driver=BOB), "Firefox plays a recording to ada."),
    "a recording on a topic": (
        SEAT._replace(topic="/a/v", plays=True), "You play a recording, on /a/v."),
    "a form of this page": (SEAT._replace(topic="/a/v"), "You drive by a form, on /a/v."),
    "a form of another": (
        SEAT._replace(topic="/a/v", driver=BOB), "Firefox drives by a form, on /a/v."),
    "a recording of rosbag": (About(report=MOVING, publishers=PLAYS), "/rosbag_play drives ada."),
    "a joystick at rest": (
        About(report=ARMED, publishers=PLAYS),
        "Nobody drives. Publishers of its joystick topic: /rosbag_play."),
    "an anonymous joystick": (About(report=MOVING, publishers=("/play_host_81_1764250000000",)),
        "/play_host_… drives ada."),
    "without diagnostics": (About(publishers=PLAYS, moves=True), "/rosbag_play drives ada."),
    "no joystick": (About(moves=True),
        "No joystick drives ada, but it moves: the tab Graph shows what moves it."),
}  # fmt: skip


@pytest.mark.parametrize("case", WHO)
def test_who_drives(case):
    about, said = WHO[case]
    assert reasons.who(about, "ada", ANNA) == said
    assert reasons.who(about, "", ANNA) == said.replace("ada", "the robot")
    assert (reasons.driver(about) == "") == said.startswith(("Nobody", "No joystick"))


@claim("A page says how ...", because="every kind of node")
def test_a_rival_is_paused_where_it_can_be_and_else_ended():
    """A rosbag that ends also ends the launch file that started it, and with it the page."""
    rival = lambda node: reasons.rival(node, {"/rosbag/pause_playback"})  # noqa: E731
    paused = "(tab Topics, Show: services, /rosbag/pause_playback, data: true)"
    assert paused in rival("/rosbag")
    assert "(Ctrl-C in its terminal, or rosnode kill /joy_node)" in rival("/joy_node")


UNHEARD = (
    "No node subscribes to /ada/joy: nothing moves before you start joy2twist for ada "
    "(ROS_NAMESPACE=ada rosrun joy2twist joy2twist.py)."
)
WITH_MUX = UNHEARD.replace(").", " cmd_vel:=cmd_vel_mux/input/teleop).")
BY_LB = "Hold LB (a thumb, a gamepad's button, the key Shift), then move the stick (or arrow keys)."
BY_77 = "Hold button 77 (a gamepad's button), then move the stick (or arrow keys)."
FREELY = "Move the stick (a thumb, a gamepad, the arrow keys)."
READY = {  # -> why the robot stands and what to do; how to drive it, without "Esc: stop."
    "drives": (SEAT, "Hold LB, then move the stick.", BY_LB),
    "pushes alone": (SEAT._replace(pushes=True),
        "The stick alone moves nothing: hold LB, too.", BY_LB),
    "sits down": (SEAT._replace(armed=False), "Release LB and the stick first.", BY_LB),
    "was stopped": (SEAT._replace(armed=False, why="hidden"),
        "Stopped: hidden. Release LB and the stick, then hold LB again.", BY_LB),
    "no button": (SEAT._replace(report=FREE),
        "Move the stick: this robot needs no button held.", FREELY),
    "a button without a name": (SEAT._replace(report=Report("armed", "", "77")),
        "Hold button 77, then move the stick.", BY_77),
    "plays": (SEAT._replace(plays=True), "", ""),
    "looks on": (About(), "", BY_LB),
    "another page drives": (SEAT._replace(driver=BOB), "", ""),
    "a node drives": (About(report=MOVING), "", ""),
    "it stopped": (About(report=ARMED, why="the network is down"),
        "Stopped: the network is down.", BY_LB),
    "without joy2twist": (SEAT._replace(has_subscriber=False, armed=False), UNHEARD, ""),
    "without joy2twist, stopped": (
        About(has_subscriber=False, why="it"), f"Stopped: it. {UNHEARD}", ""),
    "without joy2twist, beside a multiplexer": (
        About(has_subscriber=False, has_mux=True), WITH_MUX, ""),
}  # fmt: skip


@pytest.mark.parametrize("case", READY)
def test_the_page_says_why_the_robot_stands_and_what_to_do(case):
    about, said, how = READY[case]
    assert reasons.ready(about, "ada", ANNA, "") == said
    assert reasons.how_to(about, ANNA, may_drive=True) == f"{how} Esc: stop." * bool(how)
    assert reasons.how_to(about, ANNA, may_drive=False) == ""
    if about.driver is None:
        viewed = reasons.ready(about, "ada", ANNA, LOOKS_ONLY)
        assert viewed == f"{said} {sentence(LOOKS_ONLY)}".strip()
