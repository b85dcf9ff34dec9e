"""Every sentence about what drives a robot, why it stands, and what to do."""

import re
from typing import Container, Dict, Iterable, NamedTuple, Optional, Tuple

from cockpit_server.graph import topic_of
from gamepad.gamepads import F710
from node_kit.rules.arming import DRIVING

NO_ROBOT = "no robot is running yet: start one, for example with ./tutorial demo"
MUX_INPUT = "cmd_vel_mux/input/teleop"  # A TurtleBot's multiplexer takes it.
TURTLES = "only turtles are running, which turtle_teleop_key moves: ./tutorial demo starts a robot"


class Report(NamedTuple):
    """What joy2twist reports."""

    state: str
    why: str = ""  # the whole line
    deadman: Optional[str] = None  # number of the dead-man button, "none", or None: not reported


class About(NamedTuple):
    """What is known about the driver of a robot."""

    driver: Optional[int] = None  # number of the page that drives it
    name: str = ""  # name of the page that drives it
    plays: bool = False  # whether that page plays a recording
    topic: str = ""  # on which a form of that page publishes, or its recording
    armed: bool = False  # whether stick and buttons were released since the last loss
    pushes: bool = False  # whether the page moves the stick and holds no button
    why: str = ""  # why the loss of a driver has stopped the robot, or ""
    report: Optional[Report] = None
    publishers: Tuple[str, ...] = ()  # other nodes that publish its joystick
    moves: bool = False  # by its odometry
    has_subscriber: bool = True  # a node subscribes to its joystick
    has_mux: bool = False  # a node subscribes to its MUX_INPUT
    no_reset: str = "there is no robot to reset"  # why it cannot be reset, or ""

    @property
    def is_driven_by_node(self) -> bool:
        if self.driver is not None:
            return False
        if self.report:
            return self.report.state == DRIVING
        return self.moves and bool(self.publishers)


def driver(about: About) -> str:
    """Return the name of the page or node that drives, for a table; "" if none does."""
    if about.driver is not None:
        return about.name
    return (brief(about.publishers, ", ") or "a joystick") if about.is_driven_by_node else ""


def brief(nodes: Iterable[str], separator: str) -> str:
    """Return names of nodes without the numbers that rospy and roscpp give anonymous nodes."""
    return separator.join(re.sub(r"_\d+_\d{10,}$|_\d{16,}$", "_…", node) for node in nodes)


def rival(node: str, services: Container[str]) -> str:
    """Return what to do about a node that publishes the joystick topic of a robot."""
    # rosbag play has this service. Ending it may end its launch file, and with it the cockpit.
    pause = f"{node}/pause_playback"
    if pause in services:
        todo = f"pause it first (tab Topics, Show: services, {pause}, data: true)"
    else:
        todo = f"end it first (Ctrl-C in its terminal, or rosnode kill {node})"
    return f"{node} publishes the joystick topic of this robot: {todo}"


def row(about: About) -> Dict[str, str]:
    """Return the row of a robot in the table: its driver, and joy2twist's state and line."""
    report = about.report or Report("unknown")
    return {"driver": driver(about), "state": report.state, "why": report.why}


def who(about: About, robot: str, page: int) -> str:
    """Return a sentence for a page: what drives the robot."""
    name = robot or "the robot"
    if about.driver is not None:
        return by_page(about, name, about.driver == page)
    nodes = brief(about.publishers, " and ")
    if about.is_driven_by_node:
        return f"{nodes or 'A joystick'} drives {name}."
    if about.moves and not about.report:
        return f"No joystick drives {name}, but it moves: the tab Graph shows what moves it."
    if not nodes:
        return "Nobody drives."
    return f"Nobody drives. Publishers of its joystick topic: {nodes}."


def by_page(about: About, robot: str, is_own: bool) -> str:
    if about.topic:
        return on_topic(about.name, is_own, about.topic, about.plays)
    if about.plays:
        return sentence(f"{'you play' if is_own else f'{about.name} plays'} a recording to {robot}")
    return sentence(f"{'you drive' if is_own else f'{about.name} drives'} {robot}")


def on_topic(name: str, is_own: bool, topic: str, plays: bool) -> str:
    """Return a sentence for a page: how it publishes on a topic, or how the named page does."""
    if plays:
        how = "you play a recording" if is_own else f"{name} plays a recording"
    else:
        how = "you drive by a form" if is_own else f"{name} drives by a form"
    return sentence(f"{how}, on {topic}")


def again(about: About) -> str:
    """Return what a person has to do to drive again after a stop."""
    button = deadman_button(about)
    if button is None:
        return "Release the stick, then move it again."
    return f"Release {button} and the stick, then hold {button} again."


def no_subscriber(about: About, robot: str) -> str:
    topic, where = topic_of(robot, "joy"), f" for {robot}" if robot else ""
    command = f"ROS_NAMESPACE={robot} " if robot else ""
    command += "rosrun joy2twist joy2twist.py"
    command += f" cmd_vel:={MUX_INPUT}" if about.has_mux else ""
    todo = f"nothing moves before you start joy2twist{where} ({command})"
    return f"No node subscribes to {topic}: {todo}."


def sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}." if text else ""


def ready(about: About, robot: str, page: int, refusal: str) -> str:
    """Return why the robot stands, and what the person at a page can do now.

    refusal: why the page may not drive it, or "".
    """
    stopped = f"Stopped: {about.why}." if about.why else ""
    if not about.has_subscriber:
        return " ".join(filter(None, (stopped, no_subscriber(about, robot), sentence(refusal))))
    button = deadman_button(about)
    if about.driver != page:
        todo = sentence(refusal)
    elif about.plays or about.topic:
        todo = ""
    elif not about.armed:
        controls = f"{button} and the stick" if button else "the stick"
        todo = again(about) if stopped else f"Release {controls} first."
    elif button is None:
        todo = "Move the stick: this robot needs no button held."
    elif about.pushes:
        todo = f"The stick alone moves nothing: hold {button}, too."
    else:
        todo = f"Hold {button}, then move the stick."
    return f"{stopped} {todo}".strip()


def how_to(about: About, page: int, may_drive: bool) -> str:
    """Return how a hand on a page drives this robot; "" if it cannot now."""
    has_other_driver = about.driver not in (None, page) or about.is_driven_by_node
    is_busy = has_other_driver or about.plays or about.topic
    if not may_drive or is_busy or not about.has_subscriber:
        return ""
    button = deadman_button(about)
    if button is None:
        return "Move the stick (a thumb, a gamepad, the arrow keys). Esc: stop."
    by = "a thumb, a gamepad's button, the key Shift" if button == "LB" else "a gamepad's button"
    return f"Hold {button} ({by}), then move the stick (or arrow keys). Esc: stop."


def deadman_button(about: About) -> Optional[str]:
    """Return the name of the dead-man button, or None if joy2twist needs none."""
    number = about.report.deadman if about.report else None
    if number is None:
        return "LB"  # the dead-man button of the suite's presets
    names = F710["D"].buttons
    if number.isdigit():
        return names[int(number)] if int(number) < len(names) else f"button {number}"
    return None


def lost_text(why: str, keeps_session: bool) -> str:
    return f"Stopped: {why}." if keeps_session else f"This page no longer drives: {why}."
