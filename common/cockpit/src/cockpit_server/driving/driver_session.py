"""The session of the page that drives, and when its operator is lost.

`now` is the time [s] of a clock that never jumps.

The rule for every loss: one neutral message, then silence until all buttons and sticks have been
released. A page that is still connected keeps the session.
"""

from __future__ import annotations

import math
from typing import Callable, NamedTuple, Tuple

from cockpit_server.errors import RefusedError
from gamepad.gamepads import triggers_by_count
from node_kit.rules.released import are_released

SILENCE_S = 0.2  # After this time without a fresh input the operator is lost.
LATE_S = 0.1  # An input that took this much longer than the fastest one is dropped.
# A gamepad is frozen if its own clock stops for FROZEN_S after it advanced in TICKS inputs without
# movement. Where only movements advance it (Chromium on Linux, gamepad_device_linux.cc), a still
# stick is no loss.
FROZEN_S = 0.2
TICKS = 8
AWAY_S = 5.0  # After this time without a fresh input the session is free again.
KEPT_BEATS = 16  # [beats] as many as are sent in several SILENCE_S
CLOCK_DRIFT = 1e-3  # the page's clock may be slower than ours by this; crystals: a tenth
Axes = Tuple[float, ...]
Buttons = Tuple[int, ...]


class PageInput(NamedTuple):
    """What a hand on a page does, and when; axes and buttons are as on /joy."""

    n: int  # number of the message
    t: float  # the page's clock [ms]
    beat: int  # the newest beat of the server that the page has received
    axes: Axes
    buttons: Buttons
    pad: float | None = None  # the gamepad's own clock, any unit; None: a hand on glass or keys


class Delay:
    """How much longer a message took than the fastest message of its page."""

    def __init__(self) -> None:
        self._least = math.inf  # our clock, slowed by CLOCK_DRIFT, minus the page's

    def of(self, t: float, now: float) -> float:
        """Return the delay [s] of a message that the page sent at t of its clock [ms]."""
        late = now * (1 - CLOCK_DRIFT) - t / 1000
        self._least = min(late, self._least)
        return late - self._least


def neutral_of(axes: Axes, buttons: Buttons) -> tuple[Axes, Buttons]:
    """Return (axes, buttons) of the same gamepad while it is released."""
    triggers = triggers_by_count(len(axes))
    return tuple([1.0 if i in triggers else 0.0 for i in range(len(axes))]), (0,) * len(buttons)


def is_neutral(axes: Axes, buttons: Buttons) -> bool:
    rest, _ = neutral_of(axes, buttons)
    return not any(buttons) and are_released(a - r for a, r in zip(axes, rest))


class DriverSession:
    """The session of the one driver. Pages are numbers, robots are names."""

    def __init__(
        self, send: Callable[[str, Axes, Buttons], None], lost: Callable[[int, str], None]
    ) -> None:
        """send: called with (robot, axes, buttons) for each message to publish.

        lost: called with (page, why) when a page has lost its robot.
        """
        self._send, self._report_lost = send, lost
        self._has_ended = False
        self._beats: dict[int, float] = {}  # number -> when it was sent [s]
        self.driver: int | None = None
        self.stopped: str | None = None  # the robot that the last loss has stopped
        self.why = ""  # why it has stopped it, or ""
        self._pad: float | None = None
        self._clear()

    def _clear(self) -> None:
        self.driver, self.robot = None, ""
        self.plays = False  # a recording, in place of a hand
        self.topic = ""  # on which a form or a recording publishes, in place of a joystick
        self._end_motion: Callable[[], object] | None = None  # Called at the end.
        self.armed = False  # whether everything was released since the last loss
        self.newest = 0  # number of the newest input that was fresh
        self._last: tuple[Axes, Buttons] | None = None  # published last
        self._fresh_at = math.nan  # [s] arrival of the last fresh input
        self._delay = Delay()
        self._pad, self._pad_at = None, math.nan  # the gamepad's clock; when it last advanced [s]
        self._ticks = 0  # how often it advanced while nothing moved
        self._newest: tuple[Axes, Buttons] | None = None  # None before the first input

    @property
    def state(self) -> tuple[int | None, str, bool, bool, str]:
        return self.driver, self.robot, self.plays, self.armed, self.why

    @property
    def pushes(self) -> bool:
        """Whether the hand moves the stick and holds no button."""
        return self._last is not None and not any(self._last[1]) and not is_neutral(*self._last)

    @property
    def is_by_hand(self) -> bool:
        return not self.plays and not self.topic

    def take(
        self, page: int, robot: str, now: float, *, plays: bool = False, topic: str = "",
        rest: Callable[[], object] | None = None,
    ) -> None:  # fmt: skip
        """Begin the session of a page. rest: called once, at its end.

        Raises RefusedError if another page has it.
        """
        refusal = self.refusal(page)
        if refusal:
            raise RefusedError(refusal)
        self.leave(page)
        self.driver, self.robot, self.plays = page, robot, plays
        self.topic, self._end_motion = topic, rest
        self.why, self.stopped = "", None
        self.armed = plays  # A recording cannot be released first.
        self._fresh_at = now
        self._beats.clear()

    def publish(
        self, page: int, robot: str, topic: str, rest: Callable[[], object], now: float
    ) -> None:
        """Begin a session with a form that publishes on a topic. rest: called once, at its end.

        Raises RefusedError if another page has the session.
        """
        self.take(page, robot, now, topic=topic, rest=rest)
        self.armed = True
        self._fresh_at = now + SILENCE_S  # The first beat needs time to the page and back.

    def sign(self, page: int, message: PageInput, now: float) -> bool:
        """Process a sign of life of the page whose form drives; return whether it is fresh."""
        self.tick(now)
        if page != self.driver or not self.topic or not self._is_fresh(message, now):
            return False
        self.newest, self._fresh_at = message.n, max(now, self._fresh_at)
        return True

    def refusal(self, page: int) -> str:
        """Return why a page may not begin a session, or ""."""
        if self._has_ended:
            return "the cockpit is being shut down"
        if self.driver in (None, page):
            return ""
        remedy = "its driver may hand over" if self.is_by_hand else "Stop ends that"
        return f"another page drives; {remedy}"

    def leave(self, page: int) -> None:
        if page == self.driver:
            self._rest()
            self._clear()

    def hand_over(self, page: int, to: int, now: float) -> None:
        """Hand the session to another page. Raises RefusedError."""
        if page != self.driver or not self.is_by_hand:
            raise RefusedError("only the page that drives may hand over")
        robot = self.robot
        self.leave(page)
        self.take(to, robot, now)

    def beat(self, number: int, now: float) -> None:
        self._beats[number] = now
        self._beats.pop(number - KEPT_BEATS, None)

    def input(self, page: int, message: PageInput, now: float, may_arm: bool = True) -> None:
        """Process an input, unless it is old or not the driver's.

        may_arm: whether all subscribers of this joystick will receive the released state.
        """
        self.tick(now)  # It may end a silence that was too long.
        if page != self.driver or not self.is_by_hand or not self._is_fresh(message, now):
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

    def _is_fresh(self, message: PageInput, now: float) -> bool:
        late_s = self._delay.of(message.t, now)
        seen = self._beats.get(message.beat, -math.inf)
        return message.n > self.newest and late_s <= LATE_S and now - seen <= SILENCE_S

    def _is_frozen(self, message: PageInput, now: float) -> bool:
        still = (message.axes, message.buttons) == self._newest
        self._newest = (message.axes, message.buttons)
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
        """Stop the robot; the page keeps the session, as it may still be connected."""
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
        """Keep the reason for a stop, if the robot moved until now."""
        if self._end_motion or (self._last is not None and not is_neutral(*self._last)):
            self.why, self.stopped = why, self.robot

    def moves_on(self, robot: str) -> None:
        """Forget why a robot was stopped, as it moves again."""
        if robot == self.stopped:
            self.why, self.stopped = "", None

    def release(self, page: int, why: str) -> None:
        if page == self.driver:
            self.lose(why)

    def gone(self, page: int) -> None:
        if page == self.driver:
            self.free("the page was closed, or the network is down")

    def end(self) -> None:
        self.free("the cockpit was shut down")
        self._has_ended = True

    def _rest(self) -> None:
        if self._end_motion:
            self._end_motion()
            self._end_motion = None
        if self._last is not None:
            self._publish(*neutral_of(*self._last))
            self._last = None

    def _publish(self, axes: Axes, buttons: Buttons) -> None:
        self._last = (axes, buttons)
        self._send(self.robot, axes, buttons)
