"""The joystick driver's rules (Driver and its parts), judged by (a) to (d).

The driver must not deceive its subscribers: it never publishes "released" for a gamepad in an
unknown state, publishes a loss before it is silent, and then is silent for longer than joy2twist
waits.
"""

import math
import struct

from gamepad.driver.driver import LONGEST_LIFELESS_S, Driver
from gamepad.driver.parameters import load
from gamepad.js_event import AXIS, BUTTON, INIT, SIGN_OF_LIFE_MS
from tutorial_faults.worlds import TICK, World

LARGEST = 1.0001  # a little beyond 1: a kernel never gives -32768, but others may
JOY_TIMEOUT_S = 0.5  # joy2twist's default
COALESCE_S, REPEAT_S = 0.15, 0.3
GIVEN = {"coalesce_interval": COALESCE_S, "autorepeat_rate": 1.0 / REPEAT_S}


def event(kind, value, number=0, time_ms=0):
    """Return the bytes of an event of linux/joystick.h."""
    return struct.pack("=IhBB", time_ms, value, kind, number)


LOST = "lost"
OPEN = {"open: of the kernel": True, "open: a virtual one": False}


class Gamepad:
    """What the bytes say about the open gamepad."""

    def __init__(self, is_of_kernel):
        """It was opened just now."""
        self.is_of_kernel = is_of_kernel
        self.rest = b""
        self.changed = False
        self.pressed = None  # button 0; None: unknown

    def feed(self, data):
        """Return (changes, whether a sign of life was among them, whether noise was).

        A change is (kind, value); kind: BUTTON, AXIS, or 0 for the state at opening.
        """
        data, changes, signed, noisy = self.rest + data, [], False, False
        whole = len(data) // 8 * 8
        for time_ms, value, flags, _ in struct.iter_unpack("=IhBB", data[:whole]):
            is_sign = bool(flags & INIT) and time_ms == SIGN_OF_LIFE_MS and not self.is_of_kernel
            signed = signed or is_sign
            is_state = bool(flags & INIT) and not (self.is_of_kernel and self.changed)
            self.changed = self.changed or not flags & INIT
            kind = flags & ~INIT
            if is_sign and self.pressed is not None:
                continue
            if kind == BUTTON:
                self.pressed = int(value != 0)
            if kind in (BUTTON, AXIS):
                changes.append((0 if is_state else kind, value))
            else:
                noisy = True
        self.rest = data[whole:]
        return changes, signed, noisy


class DriverWorld(World):
    """The real Driver, and the invariants that it must keep."""

    def __init__(self):
        """Nothing was opened yet."""
        self._driver = Driver(load(GIVEN))
        self._pad = None  # the open Gamepad
        self._is_mute = self._has_published = False
        self._since_s = math.inf  # the first change that was not published
        self._published_s = math.inf  # the last message of this gamepad
        self._sign_due_s = math.inf  # when a sign of life must have come

    def happen(self, event):
        is_open = self._pad is not None
        if event == TICK:
            yield from self._judge(self._driver.tick(self.now))
            yield from self._must_be_called(True)
        elif event == LOST and is_open:
            yield from self._lose()
        elif event in OPEN and not is_open and self.now >= self._driver.opens_at:
            self._driver.opened((), OPEN[event])
            self._pad = Gamepad(OPEN[event])
            self._since_s = self._published_s = self._sign_due_s = math.inf
        elif isinstance(event, bytes) and is_open:
            yield from self._read(event)
            yield from self._must_be_called()

    def _lose(self):
        messages = self._driver.lost(self.now)
        if self._has_published and not messages:
            yield "d", "the loss of the gamepad is not published"
        if messages and not self._has_published:
            yield "b", "the loss of a gamepad that was not published before is published"
        if any(any((*axes, *buttons)) for axes, buttons in messages):
            yield "d", f"a lost gamepad is not published as released: {messages}"
        if self._driver.opens_at - self.now <= JOY_TIMEOUT_S:
            yield "b", "the next gamepad is opened before joy2twist can notice the loss"
        if self._driver.due != math.inf:
            yield "d", "something is due for a gamepad that is lost"
        self._pad, self._is_mute, self._has_published = None, True, False

    def _read(self, data):
        changes, signed, noisy = self._pad.feed(data)
        if any(kind for kind, _ in changes):
            self._is_mute = False
        must_give = noisy and not self._pad.is_of_kernel and self._sign_due_s == math.inf
        if signed or must_give:
            self._sign_due_s = self.now + LONGEST_LIFELESS_S
        messages = self._driver.read(data, self.now)
        if changes and self._since_s == math.inf:
            self._since_s = self.now
        yield from self._judge(messages)
        published = [bool(buttons and buttons[0]) for _, buttons in messages]
        presses = [bool(value) for kind, value in changes if kind == BUTTON]
        if presses and published[-len(presses) :] != presses:
            yield "d", f"pressed and released: {presses}, and published was {published}"

    def _judge(self, messages):
        for axes, _ in messages:
            if self._pad is None or self._is_mute:
                yield "b", "publishes a gamepad that was not touched since it is back"
            if not all(abs(value) <= LARGEST for value in axes):
                yield "c", f"axes beyond their ends: {axes}"
        if messages and self._pad:
            if bool(self._pad.pressed) != any(messages[-1][1]):
                yield "a", f"the button is {self._pad.pressed}, and published is {messages[-1]}"
            self._has_published = True
            self._since_s, self._published_s = math.inf, self.now

    def _must_be_called(self, has_ticked=False):
        """Yield what is wrong with the time of the next call."""
        driver, now = self._driver, self.now
        if self._pad is None:
            return
        if not self._is_mute:
            latest = min(self._since_s + COALESCE_S, self._published_s + REPEAT_S)
            if driver.due > latest or (has_ticked and latest <= now):
                yield "d", "a change or the repetition will be published too late"
        if driver.due > self._sign_due_s or driver.is_lifeless(now) != (now >= self._sign_due_s):
            yield "d", "a gamepad without a sign of life is not noticed"
