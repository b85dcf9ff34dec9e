"""The words for what drives a robot, why it stands, and what to do; all of them here (pure)."""

import re
from typing import Container, Dict, Iterable, NamedTuple, Optional, Tuple

from cockpit_server.graph import topic_of
from gamepad.gamepads import F710
from node_kit.rules.arming import DRIVING

NO_ROBOT = "no robot is running yet: start one, for example with ./tutorial demo"
TURTLES = "only turtles are running, which turtle_teleop_key moves: ./tutorial demo starts a robot"


class Report(NamedTuple):
    """What joy2twist reports."""

    state: str
    why: str = ""  # the whole line
    deadman: Optional[str] = None  # number of that button, "none", or None if not reported


class About(NamedTuple):
    """What is known of one robot."""

    driver: Optional[int] = None  # number of the page that drives it
    name: str = ""  # name of the page that drives it
    plays: bool = False  # whether that page plays a recording
    topic: str = ""  # on which a form of that page publishes
    armed: bool = False  # whether all was seen released
    pushes: bool = False  # whether its hand moves the stick, and holds no button
    why: str = ""  # the last stop by a loss of the driver
    said: Optional[Report] = None
    senders: Tuple[str, ...] = ()  # other nodes that publish its joystick's topic
    moves: bool = False  # whether its odometry says so
    is_heard: bool = True  # whether a node subscribes to its joystick's topic
    no_reset: str = "there is no robot to reset"  # why it cannot be reset, or ""

    @property
    def is_driven_by_node(self) -> bool:
        if self.driver is not None:
            return False
        return self.said.state == DRIVING if self.said else self.moves and bool(self.senders)


def driver(about: About) -> str:
    """Return the name of what drives, for a table; "" if nothing does."""
    if about.driver is not None:
        return about.name
    return (brief(about.senders, ", ") or "a joystick") if about.is_driven_by_node else ""


def brief(nodes: Iterable[str], between: str) -> str:
    """Return nodes without the numbers that rospy, or roscpp, gives anonymous ones."""
    return between.join(re.sub(r"_\d+_\d{10,}$|_\d{16,}$", "_…", node) for node in nodes)


def rival(node: str, services: Container[str]) -> str:
    """Return what to do about a node that publishes the joystick topic of a robot."""
    # rosbag play has this service. Ending it may end a launch file, and the cockpit with it.
    pause = f"{node}/pause_playback"
    if pause in services:
        todo = f"pause it first (tab Topics, Show: services, {pause}, data: true)"
    else:
        todo = f"end it first (Ctrl-C in its terminal, or rosnode kill {node})"
    return f"{node} publishes the joystick topic of this robot: {todo}"


def in_a_table(about: About) -> Dict[str, str]:
    """Return the row of a robot: what drives it, and joy2twist's state and line."""
    report = about.said or Report("unknown")
    return {"driver": driver(about), "state": report.state, "why": report.why}


def who(about: About, robot: str, page: int) -> str:
    """Return a sentence that says to a page what drives the robot."""
    its = robot or "the robot"
    if about.driver is not None:
        return by_page(about, its, about.driver == page)
    some = brief(about.senders, " and ")
    if about.is_driven_by_node:
        return f"{some or 'A joystick'} drives {its}."
    if about.moves and not about.said:
        return f"No joystick drives {its}, but it moves: the tab Graph shows what moves it."
    if not some:
        return "Nobody drives."
    return f"Nobody drives. Publishers of its joystick topic: {some}."


def by_page(about: About, its: str, is_own: bool) -> str:
    if about.topic:
        return by_form(about.name, is_own, about.topic)
    if about.plays:
        return sentence(f"{'you play' if is_own else f'{about.name} plays'} a recording to {its}")
    return sentence(f"{'you drive' if is_own else f'{about.name} drives'} {its}")


def by_form(name: str, is_own: bool, topic: str) -> str:
    """Return a sentence for a page: its own form drives, or that of the page of this name."""
    return sentence(f"{'you drive' if is_own else f'{name} drives'} by a form, on {topic}")


def again(about: About) -> str:
    """Return what to do after a stop, before the robot may be driven again."""
    button = held(about)
    if button is None:
        return "Release the stick, then move it again."
    return f"Release {button} and the stick, then hold {button} again."


def unheard(robot: str) -> str:
    topic, where = topic_of(robot, "joy"), f" for {robot}" if robot else ""
    return f"No node subscribes to {topic}: nothing moves before you start joy2twist{where}."


def sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}." if text else ""


def ready(about: About, robot: str, page: int, refusal: str) -> str:
    """Return why the robot stands, and what the person at a page is to do now.

    refusal: why the page may not drive it, or "".
    """
    stopped = f"Stopped: {about.why}." if about.why else ""
    if not about.is_heard:
        return " ".join(filter(None, (stopped, unheard(robot), sentence(refusal))))
    button = held(about)
    if about.driver != page:
        todo = sentence(refusal)
    elif about.plays or about.topic:
        todo = ""
    elif not about.armed:
        some = f"{button} and the stick" if button else "the stick"
        todo = again(about) if stopped else f"Release {some} first."
    elif button is None:
        todo = "Move the stick: this robot needs no button held."
    elif about.pushes:
        todo = f"The stick alone moves nothing: hold {button}, too."
    else:
        todo = f"Hold {button}, then move the stick."
    return f"{stopped} {todo}".strip()


def how_to(about: About, page: int, may_drive: bool) -> str:
    """Return how a page drives this robot; "" where a hand can do nothing now."""
    is_others = about.driver not in (None, page) or about.is_driven_by_node
    if not may_drive or is_others or about.plays or about.topic or not about.is_heard:
        return ""
    button = held(about)
    if button is None:
        return "Move the stick (a thumb, a gamepad, the arrow keys). Esc: stop."
    by = "a thumb, a gamepad's button, the key Shift" if button == "LB" else "a gamepad's button"
    return f"Hold {button} ({by}), then move the stick (or arrow keys). Esc: stop."


def held(about: About) -> Optional[str]:
    """Return the name of the dead-man button, None if joy2twist needs none."""
    number = about.said.deadman if about.said else None
    if number is None:
        return "LB"  # as the suite's presets have it
    names = F710["D"].buttons
    if number.isdigit():
        return names[int(number)] if int(number) < len(names) else f"button {number}"
    return None


def lost_text(why: str, keeps_session: bool) -> str:
    return f"Stopped: {why}." if keeps_session else f"This page no longer drives: {why}."
