"""Virtual gamepads: made by the kernel, or served through a FIFO where the kernel cannot."""

import contextlib
import fcntl
import math
import os
import select
import stat
import time

from gamepad.js_event import AXIS, BUTTON, INIT, SIGN_OF_LIFE_MS, JsEvent, pack

UINPUT = "/dev/uinput"
BUS_USB = 3  # linux/input.h
EV_KEY, EV_ABS = 1, 3  # linux/input-event-codes.h
# How often a FIFO repeats the state at opening: so its reader knows that this program lives [s].
SIGN_OF_LIFE_S = 0.15
TREMBLE_S = 0.4  # how often a held stick of a kernel device trembles, for the same reason
LOOK_S = 0.05  # how often a FIFO without a reader is looked at


class PadError(Exception):
    """A virtual gamepad cannot be made; the text says in one line why and what to do."""


class UinputPad:
    """A gamepad that the kernel shows to every program, as /dev/input/jsN and eventN."""

    def __init__(self, gamepad):
        """gamepad: gamepads.Gamepad. Raises PadError."""
        try:
            import evdev  # noqa: PLC0415  a FIFO does not need it
        except ImportError:
            raise PadError("python3-evdev is missing: apt install python3-evdev") from None
        self._evdev = evdev
        self._gamepad = gamepad
        self._device = None
        self._raw = {}  # (type, code) -> value sent last
        self._position, self._bent = None, False  # shown last; whether its sticks are one step off
        self._plug_in()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.show(None)

    def _plug_in(self):
        pad = self._gamepad
        info = [
            (axis.code, self._evdev.AbsInfo(raw, axis.low, axis.high, 0, 0, 0))
            for axis, raw in zip(pad.axes, pad.untouched)
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

    def show(self, position):
        """Move to (axes, buttons) as on /joy; None: unplugged.

        The same position once more: held sticks tremble, as a hand does.
        """
        if position is None:
            if self._device:
                self._device.close()
            self._device, self._raw = None, {}
            return
        if not self._device:
            self._plug_in()
        axes, buttons = position
        pad = self._gamepad
        raws = [axis.raw(value) for axis, value in zip(pad.axes, axes)]
        self._bent = position == self._position and not self._bent
        raws = pad.trembled(raws) if self._bent else raws
        self._position = position
        raw = {(EV_ABS, axis.code): value for axis, value in zip(pad.axes, raws)}
        raw.update({(EV_KEY, code): value for code, value in zip(pad.button_codes, buttons)})
        changes = raw.items() - self._raw.items()
        for (kind, code), value in sorted(changes):
            self._device.write(kind, code, value)
        if changes:
            self._device.syn()
        self._raw = raw

    connected = True  # whether somebody may read; nobody can tell

    def watch(self, poll):
        """Nothing to be watched; returns the longest time to wait [s]."""
        return TREMBLE_S


class StreamPad:
    """The events of the joystick device, served through a FIFO to one reader after the other."""

    def __init__(self, gamepad, path, clock=time.monotonic):
        """gamepad: gamepads.Gamepad. path: of the FIFO, made if missing. clock: gives seconds.

        Raises PadError.
        """
        self._gamepad, self._path, self._clock = gamepad, path, clock
        self.gives_signs = True  # of life; the receiver of a radio gamepad gives none
        self._fd = None
        self._told = {}  # (type, number) -> value, as the reader knows them
        self._signed_at = -math.inf  # when the last sign of life was given
        try:
            self._made = not os.path.lexists(path)
            if self._made:
                os.mkfifo(path, 0o600)
            elif not stat.S_ISFIFO(os.stat(path).st_mode):
                raise PadError(f"{path} is there and is no FIFO: choose another path")
        except OSError as error:
            raise PadError(f"cannot make the FIFO {path}: {error.strerror}") from None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.show(None)
        if self._made:
            with contextlib.suppress(OSError):
                os.unlink(self._path)

    def show(self, position):
        """Move to (axes, buttons) as on /joy; None: unplugged. Raises PadError."""
        if position is None:
            self._close()
            return
        if self._fd is not None and self._reader_left():
            self._close()
        if self._fd is None and not self._open():
            return
        axes, buttons = position
        values = {(BUTTON, i): value for i, value in enumerate(buttons)}
        for i, (axis, value) in enumerate(zip(self._gamepad.axes, axes)):
            values[AXIS, i] = axis.js_value(axis.raw(value))
        self._tell({key: value for key, value in values.items() if self._told.get(key) != value})
        is_due = self._clock() >= self._signed_at + SIGN_OF_LIFE_S
        if self._told and is_due and self.gives_signs:
            self._signed_at = self._clock()
            self._tell(dict(self._told), INIT, SIGN_OF_LIFE_MS)

    def watch(self, poll):
        """Have poll notice a reader that leaves; returns the longest time to wait [s]."""
        if self._fd is None:
            return LOOK_S
        poll.register(self._fd, 0)
        return SIGN_OF_LIFE_S

    @property
    def connected(self):
        """Whether somebody reads."""
        return self._fd is not None

    def _open(self):
        try:
            self._fd = os.open(self._path, os.O_WRONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError:
            return False  # nobody reads
        try:
            fcntl.flock(self._fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._close()
            self._made = False  # it belongs to the other one
            raise PadError(
                f"another virtual_joystick serves {self._path}: end it, or choose another path"
            ) from None
        # As the kernel does at opening: everything, untouched.
        self._told = {}
        untouched = {(BUTTON, i): 0 for i in range(len(self._gamepad.buttons))}
        for i, (axis, raw) in enumerate(zip(self._gamepad.axes, self._gamepad.untouched)):
            untouched[AXIS, i] = axis.js_value(raw)
        self._tell(untouched, INIT)
        self._signed_at = self._clock()
        return self._fd is not None

    def _reader_left(self):
        poll = select.poll()
        poll.register(self._fd, 0)  # tells of errors only
        return bool(poll.poll(0))

    def _tell(self, values, flag=0, time_ms=None):
        if time_ms is None:
            time_ms = int(self._clock() * 1000) % SIGN_OF_LIFE_MS
        events = [JsEvent(time_ms, value, kind | flag, n) for (kind, n), value in values.items()]
        data = b"".join(map(pack, events))
        try:
            os.write(self._fd, data)  # less than PIPE_BUF: all of it, or nothing
            self._told.update(values)
        except BlockingIOError:
            pass  # the reader is behind; what differs is told next time
        except OSError:
            self._close()

    def _close(self):
        if self._fd is not None:
            os.close(self._fd)
        self._fd, self._told = None, {}
