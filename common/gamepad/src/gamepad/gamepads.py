"""The Logitech F710 as the kernel sees it, and the meaning of an axis' value.

Source of axes, buttons and USB ids: the tutorial's setup memo of the F710, and in the kernel
drivers/hid/hid-input.c (D mode) and drivers/input/joystick/xpad.c (X mode). Codes:
linux/input-event-codes.h.
"""

from __future__ import annotations

from typing import NamedTuple, Sequence

from gamepad.js_event import FULL

ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_HAT0X, ABS_HAT0Y = 0, 1, 2, 3, 4, 5, 16, 17


class Axis(NamedTuple):
    """One axis. code: ABS_*. low, high: range of its raw value; low is left, up, or released."""

    code: int
    low: int
    high: int

    def raw(self, position: float) -> int:
        """Return the raw value for a position in ROS: from -1 to 1, left and up positive."""
        half = (self.high - self.low) / 2
        return min(self.high, max(self.low, round(self._middle - position * half)))

    def js_value(self, raw: int) -> int:
        """Return the value of the event for a raw value, as drivers/input/joydev.c does."""
        # Integers as in the kernel: the shift rounds down, and there is no dead zone.
        half = (self.high - self.low) // 2
        return min(FULL, max(-FULL, ((raw - self._middle) * ((1 << 29) // half)) >> 14))

    @property
    def _middle(self) -> int:
        # An even range has no middle value; the kernel takes the lower one.
        return int((self.high + self.low) / 2)


class Gamepad(NamedTuple):
    """A gamepad in one mode; axes and buttons in the order of the joystick device.

    buttons: names as printed on the gamepad. button_codes: BTN_*.
    """

    name: str
    vendor: int
    product: int
    axes: tuple[Axis, ...]
    buttons: tuple[str, ...]
    button_codes: tuple[int, ...]

    @property
    def usb_id(self) -> str:
        """The id as lsusb prints it."""
        return f"{self.vendor:04x}:{self.product:04x}"

    @property
    def triggers(self) -> tuple[int, ...]:
        """The numbers of the axes that are triggers, which rest at +1."""
        return trigger_axes([axis.code for axis in self.axes])

    def trembled(self, raws: Sequence[int]) -> list[int]:
        """Return the raw values of all axes, with held sticks one step nearer to the middle."""
        middles = [int(axis.raw(0.0)) for axis in self.axes]
        digital = [i for i, axis in enumerate(self.axes) if (axis.low, axis.high) == (-1, 1)]
        still = {*self.triggers, *digital}
        return [
            raw if i in still else raw - (raw > middles[i]) + (raw < middles[i])
            for i, raw in enumerate(raws)
        ]


def _axes(low: int, high: int, *codes: int) -> tuple[Axis, ...]:
    return tuple([Axis(code, low, high) for code in codes])


F710_D = Gamepad(
    # usbhid puts the manufacturer before the product name, which begins with it again.
    name="Logitech Logitech Cordless RumblePad 2",
    vendor=0x046D,
    product=0xC219,
    axes=_axes(0, 255, ABS_X, ABS_Y, ABS_Z, ABS_RZ) + _axes(-1, 1, ABS_HAT0X, ABS_HAT0Y),
    buttons=("X", "A", "B", "Y", "LB", "RB", "LT", "RT", "BACK", "START", "LEFT", "RIGHT"),
    # BTN_GAMEPAD and the codes after it: HID calls it a gamepad.
    button_codes=tuple(range(0x130, 0x13C)),
)
F710_X = Gamepad(
    name="Logitech Gamepad F710",
    vendor=0x046D,
    product=0xC21F,
    axes=_axes(-32768, 32767, ABS_X, ABS_Y)
    + _axes(0, 255, ABS_Z)
    + _axes(-32768, 32767, ABS_RX, ABS_RY)
    + _axes(0, 255, ABS_RZ)
    + _axes(-1, 1, ABS_HAT0X, ABS_HAT0Y),
    buttons=("A", "B", "X", "Y", "LB", "RB", "BACK", "START", "LOGITECH", "LEFT", "RIGHT"),
    # BTN_A, B, X, Y, TL, TR, SELECT, START, MODE, THUMBL, THUMBR
    button_codes=(0x130, 0x131, 0x133, 0x134, 0x136, 0x137, 0x13A, 0x13B, 0x13C, 0x13D, 0x13E),
)
F710 = {"D": F710_D, "X": F710_X}


def trigger_axes(codes: Sequence[int]) -> tuple[int, ...]:
    """Return the numbers of the axes that are triggers. codes: of all axes, in their order.

    A gamepad with triggers has the right stick on RX and RY and the triggers on Z and RZ; one
    without has the right stick on Z and RZ.
    """
    if not {ABS_RX, ABS_RY}.issubset(codes):
        return ()
    return tuple([i for i, code in enumerate(codes) if code in (ABS_Z, ABS_RZ)])


def triggers_by_count(axes: int) -> tuple[int, ...]:
    """Return the triggers of a gamepad, judged by its number of axes."""
    return F710_X.triggers if axes == len(F710_X.axes) else ()


def mode_hint(usb_id: str) -> str | None:
    """Return one line of help for an F710, else None. usb_id: as lsusb prints it."""
    if usb_id == F710_D.usb_id:
        return (
            "This is a Logitech F710 in D mode: left stick on axes 0 and 1 if the MODE LED is off "
            "(4 and 5 if it is on), LB is button 4."
        )
    if usb_id == F710_X.usb_id:
        return (
            "This is a Logitech F710 in X mode: 8 axes, the triggers are axes 2 and 5. The "
            "tutorial uses D mode: set the switch to D, or choose a joy_config for X mode."
        )
    return None
