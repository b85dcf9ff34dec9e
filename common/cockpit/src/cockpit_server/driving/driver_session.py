"""The driver, and when the operator is lost (pure).

Every method is given the time `now` [s] of one clock that never jumps; nothing here reads a clock.

The rule for every loss: one neutral message, then silence until all buttons and sticks were seen
released. A page that is still there keeps the session.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple, Tuple

from cockpit_server.clients import RefusedError
from gamepad.gamepads import triggers_by_count
from node_kit.rules.released import are_released

SILENCE_S = 0.2  # without a fresh input the operator is lost
LATE_S = 0.1  # an input that was longer on its way than the fastest one by this is dropped
FROZEN_S = 0.2  # a gamepad's own time stands still for so long: it is frozen
# If its time went on in so many inputs before, while nothing moved. Where the browser has it go on
# with movements alone (Chromium on Linux, gamepad_device_linux.cc), a stick held still is no loss.
TICKS = 8
AWAY_S = 5.0  # without any fresh input the session is free again
KEPT_BEATS = 16  # [beats] as many as are sent in several SILENCE_S
# The page's clock may run slower than ours by this; crystals differ by a tenth of it.
CLOCK_DRIFT = 1e-3
Axes = Tuple[float, ...]
Buttons = Tuple[int, ...]


class Input(NamedTuple):
    """What a page says its hand does, and when; axes and buttons are as on /joy."""

    n: int  # number of the message
    t: float  # the page's clock [ms]
    beat: int  # the newest beat of the server that the page has seen
    axes: Axes
    buttons: Buttons
    pad: float | None = None  # the gamepad's own clock, any unit; None: a hand on glass or keys


class Delay:
    """How much later than the fastest one of its page a message came."""

    def __init__(self) -> None:
        self._least = math.inf  # our clock, slowed by CLOCK_DRIFT, minus the page's

    def of(self, t: float, now: float) -> float:
        """Return the delay [s] of a message that the page sent at t of its clock [ms]."""
        late = now * (1 - CLOCK_DRIFT) - t / 1000
        self._least = min(late, self._least)
        return late - self._least


def neutral_of(axes: Axes, buttons: Buttons) -> tuple[Axes, Buttons]:
    """Return (axes, buttons) of the same gamepad when it is released."""
    triggers = triggers_by_count(len(axes))
    return tuple([1.0 if i in triggers else 0.0 for i in range(len(axes))]), (0,) * len(buttons)


def is_neutral(axes: Axes, buttons: Buttons) -> bool:
    rest, _ = neutral_of(axes, buttons)
    return not any(buttons) and are_released(a - r for a, r in zip(axes, rest))


class DriverSession:
    """The one place of the driver. A client is any number; a robot is a name."""

    def __init__(
        self, send: Callable[[str, Axes, Buttons], None], lost: Callable[[int, str], None]
    ) -> None:
        """send: called with (robot, axes, buttons) for each message to publish. lost: called with
        (client, why) when a client has lost its robot.
        """
        self._send, self._report_lost = send, lost
        self._has_ended = False
        self._beats: dict[int, float] = {}  # number -> when it was sent
        self.driver: int | None = None
        self.stopped: str | None = None  # the robot that a loss has stopped last, and why
        self.why = ""  # why a loss has stopped a robot, and which, at the last
        self._pad: float | None = None
        self._clear()

    def _clear(self) -> None:
        self.driver, self.robot = None, ""
        self.plays = False  # a recording, in place of a hand
        self.topic = ""  # on which a form of the page publishes, in place of a hand
        self._rest_form: Callable[[], object] | None = None  # publishes what ends its motion
        self.armed = False  # all was seen released since the last loss
        self.newest = 0  # number of the newest input that was taken
        self._last: tuple[Axes, Buttons] | None = None  # (axes, buttons) published last
        self._fresh_at = math.nan  # when the last fresh input came
        self._delay = Delay()
        self._pad, self._pad_at = None, math.nan  # the gamepad's clock, and when it last went on
        self._ticks = 0  # how often it did while nothing moved
        self._heard: tuple[Axes, Buttons] | None = None  # (axes, buttons) of the newest input

    @property
    def state(self) -> tuple[int | None, str, bool, bool, str]:
        return self.driver, self.robot, self.plays, self.armed, self.why

    @property
    def pushes(self) -> bool:
        """Whether the hand moves the stick, and holds no button."""
        return self._last is not None and not any(self._last[1]) and not is_neutral(*self._last)

    @property
    def is_by_hand(self) -> bool:
        return not self.plays and not self.topic

    def take(self, client: int, robot: str, now: float, *, plays: bool = False) -> None:
        """Begin the session of a client. Raises RefusedError if another one has it."""
        refusal = self.refusal(client)
        if refusal:
            raise RefusedError(refusal)
        self.leave(client)
        self.driver, self.robot, self.plays = client, robot, plays
        self.why, self.stopped = "", None
        self.armed = plays  # a recording begins as it begins
        self._fresh_at = now
        self._beats.clear()

    def publish(
        self, client: int, robot: str, topic: str, rest: Callable[[], object], now: float
    ) -> None:
        """Begin a session with a form, which publishes on a topic. rest: called once, at its end.

        Raises RefusedError if another client has it.
        """
        self.take(client, robot, now)
        self.topic, self._rest_form, self.armed = topic, rest, True
        self._fresh_at = now + SILENCE_S  # The first beat has yet to go to the page and back.

    def sign(self, client: int, message: Input, now: float) -> bool:
        """Take a sign of life of the page whose form drives; return whether it is fresh."""
        self.tick(now)
        if client != self.driver or not self.topic or not self._is_fresh(message, now):
            return False
        self.newest, self._fresh_at = message.n, max(now, self._fresh_at)
        return True

    def refusal(self, client: int) -> str:
        """Return why a client may not begin a session, or ""."""
        if self._has_ended:
            return "the cockpit is being shut down"
        if self.driver in (None, client):
            return ""
        way = "its driver may hand over" if self.is_by_hand else "Stop ends that"
        return f"another page drives; {way}"

    def leave(self, client: int) -> None:
        if client == self.driver:
            self._rest()
            self._clear()

    def hand_over(self, client: int, to: int, now: float) -> None:
        """Hand the session to another client. Raises RefusedError."""
        if client != self.driver or not self.is_by_hand:
            raise RefusedError("only the page that drives may hand over")
        robot = self.robot
        self.leave(client)
        self.take(to, robot, now)

    def beat(self, number: int, now: float) -> None:
        self._beats[number] = now
        self._beats.pop(number - KEPT_BEATS, None)

    def input(self, client: int, message: Input, now: float, may_arm: bool = True) -> None:
        """Take an Input from a client; one that is old or not the driver's is dropped. may_arm:
        whether all that hear this joystick will see that everything is released.
        """
        self.tick(now)  # a silence that was not yet noticed
        if client != self.driver or not self.is_by_hand or not self._is_fresh(message, now):
            return
        self.newest, self._fresh_at = message.n, now
        neutral = is_neutral(message.axes, message.buttons)
        if self._is_frozen(message, now) and not neutral:
            self.lose("the gamepad sends nothing new: it is frozen or out of reach")
        if neutral and may_arm:
            self.armed = True
        if self.armed:
            if not neutral:
                self.moves_on(self.robot)
            self._publish(message.axes, message.buttons)

    def _is_fresh(self, message: Input, now: float) -> bool:
        late_s = self._delay.of(message.t, now)
        seen = self._beats.get(message.beat, -math.inf)
        return message.n > self.newest and late_s <= LATE_S and now - seen <= SILENCE_S

    def _is_frozen(self, message: Input, now: float) -> bool:
        still = (message.axes, message.buttons) == self._heard
        self._heard = (message.axes, message.buttons)
        if message.pad is None or message.pad != self._pad:
            self._ticks += still and None not in (message.pad, self._pad)
            self._pad, self._pad_at = message.pad, now
            return False
        if self._ticks < TICKS:
            self._ticks = 0
            return False
        return now - self._pad_at > FROZEN_S

    def play(self, axes: Axes, buttons: Buttons) -> None:
        if self.plays:
            self._publish(axes, buttons)

    def tick(self, now: float) -> None:
        if self.driver is None or self.plays:
            return
        silent_s = now - self._fresh_at
        if self.armed and silent_s > SILENCE_S:
            self.lose(f"no input from the page for {SILENCE_S:g} s")
        if silent_s > AWAY_S:
            self.free("no input from the page for 5 s")

    def lose(self, why: str) -> None:
        """Stop the robot; the client keeps the session, as it may still be there."""
        if self.driver is None or not self.armed:
            return
        self._keep(why)
        self._rest()
        self.armed = False
        self._report_lost(self.driver, why)
        if not self.is_by_hand:
            self._clear()

    def free(self, why: str) -> None:
        """Stop the robot and free the session."""
        driver = self.driver
        if driver is None:
            return
        self._keep(why)
        self._rest()
        self._clear()
        self._report_lost(driver, why)

    def _keep(self, why: str) -> None:
        """Keep the reason of a stop, if the robot moved until now."""
        if self._rest_form or (self._last is not None and not is_neutral(*self._last)):
            self.why, self.stopped = why, self.robot

    def moves_on(self, robot: str) -> None:
        """Forget why a robot was stopped: it moves again."""
        if robot == self.stopped:
            self.why, self.stopped = "", None

    def release(self, client: int, why: str) -> None:
        if client == self.driver:
            self.lose(why)

    def gone(self, client: int) -> None:
        if client == self.driver:
            self.free("the page was closed, or the network is down")

    def end(self) -> None:
        self.free("the cockpit was shut down")
        self._has_ended = True

    def _rest(self) -> None:
        if self._rest_form:
            self._rest_form()
            self._rest_form = None
        if self._last is not None:
            self._publish(*neutral_of(*self._last))
            self._last = None

    def _publish(self, axes: Axes, buttons: Buttons) -> None:
        self._last = (axes, buttons)
        self._send(self.robot, axes, buttons)
