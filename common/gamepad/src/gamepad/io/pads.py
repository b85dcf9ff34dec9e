"""Virtual gamepads: created by the kernel, or served through a FIFO where that is impossible."""

from __future__ import annotations

import contextlib
import fcntl
import math
import os
import select
import stat
import time
from typing import Any, Callable, ContextManager, Mapping

from gamepad.errors import PadError
from gamepad.gamepads import Gamepad
from gamepad.js_event import AXIS, BUTTON, INIT, SIGN_OF_LIFE_MS, JsEvent, pack
from gamepad.virtual.controls import Controls, Position, positions

UINPUT = "/dev/uinput"
BUS_USB = 3  # linux/input.h
EV_KEY, EV_ABS = 1, 3  # linux/input-event-codes.h
# Period at which a FIFO repeats the state at opening, as a sign of life for its reader [s].
SIGN_OF_LIFE_S = 0.15
TREMBLE_S = 0.4  # period at which a held stick trembles, for the same reason
LOOK_S = 0.05  # period at which a FIFO is checked for a reader


class UinputPad(ContextManager["UinputPad"]):
    """A gamepad that the kernel shows to every program, as /dev/input/jsN and eventN."""

    connected = True  # whether a program may read; the kernel does not report it

    def __init__(self, gamepad: Gamepad) -> None:
        """Create the gamepad. Raises PadError."""
        try:
            import evdev  # noqa: PLC0415  a FIFO does not need it
        except ImportError:
            raise PadError("python3-evdev is missing: apt install python3-evdev") from None
        self._evdev = evdev
        self._gamepad = gamepad
        self._position: Position | None = None  # the last one
        self._bent = False  # whether held sticks are one step off
        self._device: Any = None
        self._plug_in()

    def __exit__(self, *_: object) -> None:
        self.show(None)

    def _plug_in(self) -> None:
        pad = self._gamepad
        axes, _ = positions(pad, Controls())
        info = [
            (axis.code, self._evdev.AbsInfo(axis.raw(value), axis.low, axis.high, 0, 0, 0))
            for axis, value in zip(pad.axes, axes)
        ]
        try:
            self._device = self._evdev.UInput(
                {EV_KEY: pad.button_codes, EV_ABS: info},
                name=pad.name, vendor=pad.vendor, product=pad.product, bustype=BUS_USB,
            )  # fmt: skip
        except (OSError, self._evdev.UInputError) as error:
            raise PadError(
                f"no virtual gamepad can be made with {UINPUT} ({error}): load it with `sudo "
                "modprobe uinput` and become its owner, or use --stream PATH, which joy_node reads "
                "with _dev:=PATH"
            ) from None

    def show(self, position: Position | None) -> None:
        """Move to (axes, buttons) as on /joy; None: unplugged.

        If the position is the same as before, held sticks tremble, as a hand does.
        """
        if position is None:
            if self._device:
                self._device.close()
            self._device = None
            return
        if not self._device:
            self._plug_in()
        axes, buttons = position
        pad = self._gamepad
        raws = [axis.raw(value) for axis, value in zip(pad.axes, axes)]
        self._bent = position == self._position and not self._bent
        raws = pad.trembled(raws) if self._bent else raws
        self._position = position
        # The kernel reports only changes.
        for code, value in zip(pad.button_codes, buttons):
            self._device.write(EV_KEY, code, value)
        for axis, value in zip(pad.axes, raws):
            self._device.write(EV_ABS, axis.code, value)
        self._device.syn()

    def watch(self, poll: select.poll) -> float:
        """Return the longest time to wait [s]; nothing needs to be polled."""
        return TREMBLE_S


class StreamPad(ContextManager["StreamPad"]):
    """The events of a joystick device, served through a FIFO to one reader at a time."""

    def __init__(
        self, gamepad: Gamepad, path: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Create the FIFO, if it does not exist. clock: returns seconds. Raises PadError."""
        self._gamepad, self._path, self._clock = gamepad, path, clock
        self.gives_signs = True  # signs of life; the receiver of a radio gamepad sends none
        self._fd: int | None = None
        self._sent: dict[tuple[int, int], int] = {}  # (type, number) -> last value that was sent
        self._signed_at = -math.inf  # when the last sign of life was sent
        self._position: Position | None = None  # the last one
        self._trembled_at = -math.inf  # when it was first shown, or last trembled
        self._bent = False  # whether held sticks are one step off
        try:
            self._made = not os.path.lexists(path)
            if self._made:
                os.mkfifo(path, 0o600)
            elif not stat.S_ISFIFO(os.stat(path).st_mode):
                raise PadError(f"{path} exists and is no FIFO: choose another path")
        except OSError as error:
            raise PadError(f"cannot make the FIFO {path}: {error.strerror}") from None

    def __exit__(self, *_: object) -> None:
        self.show(None)
        if self._made:
            with contextlib.suppress(OSError):
                os.unlink(self._path)

    @property
    def connected(self) -> bool:
        """Whether a program reads the FIFO."""
        return self._fd is not None

    def show(self, position: Position | None) -> None:
        """Move to (axes, buttons) as on /joy; None: unplugged. Raises PadError.

        If the position is the same as before, held sticks tremble: every joy_node publishes that,
        and only ours recognises the sign of life.
        """
        if position is None or (self._fd is not None and _reader_left(self._fd)):
            self._close()
        if position is None or not (self.connected or self._open()):
            return
        now = self._clock()
        if position != self._position:
            self._position, self._trembled_at, self._bent = position, now, False
        elif self.gives_signs and now >= self._trembled_at + TREMBLE_S:
            self._trembled_at, self._bent = now, not self._bent
        changes = self._events(position, self._bent).items() - self._sent.items()
        self._send(dict(sorted(changes)))
        if self._sent and now >= self._signed_at + SIGN_OF_LIFE_S and self.gives_signs:
            self._signed_at = now
            self._send(dict(self._sent), INIT, SIGN_OF_LIFE_MS)

    def watch(self, poll: select.poll) -> float:
        """Watch for the reader to leave; return the longest time to wait [s]."""
        if self._fd is None:
            return LOOK_S
        poll.register(self._fd, 0)
        return SIGN_OF_LIFE_S

    def _open(self) -> bool:
        try:
            self._fd = os.open(self._path, os.O_WRONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError:
            return False  # there is no reader
        try:
            fcntl.flock(self._fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._close()
            self._made = False  # the other program has made it
            raise PadError(
                f"another virtual_joystick serves {self._path}: end it, or choose another path"
            ) from None
        # As the kernel does at opening: the whole state, released.
        self._send(self._events(positions(self._gamepad, Controls())), INIT)
        self._signed_at = self._clock()
        return self.connected

    def _events(self, position: Position, bent: bool = False) -> dict[tuple[int, int], int]:
        """Return the value of each (type, number) in a position; bent: held sticks one step off."""
        axes, buttons = position
        rests, _ = positions(self._gamepad, Controls())
        events = {(BUTTON, i): value for i, value in enumerate(buttons)}
        for i, axis in enumerate(self._gamepad.axes):
            value = axis.js_value(axis.raw(axes[i]))
            if bent and axes[i] != rests[i]:
                # The smallest step of an event; a kernel device has coarser steps.
                value += (value < 0) - (value > 0)
            events[AXIS, i] = value
        return events

    def _send(
        self, values: Mapping[tuple[int, int], int], flag: int = 0, time_ms: int | None = None
    ) -> None:
        assert self._fd is not None
        if time_ms is None:
            time_ms = int(self._clock() * 1000) % SIGN_OF_LIFE_MS
        events = [JsEvent(time_ms, value, kind | flag, n) for (kind, n), value in values.items()]
        try:
            # Less than PIPE_BUF bytes are written completely or not at all.
            os.write(self._fd, b"".join(map(pack, events)))
            self._sent.update(values)
        except BlockingIOError:
            pass  # the reader is behind; the changes are sent next time
        except OSError:
            self._close()

    def _close(self) -> None:
        if self._fd is not None:
            os.close(self._fd)
        self._fd, self._sent = None, {}


def _reader_left(fd: int) -> bool:
    poll = select.poll()
    poll.register(fd, 0)  # reports errors only
    return bool(poll.poll(0))
