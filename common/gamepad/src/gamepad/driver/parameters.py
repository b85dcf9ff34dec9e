"""The private parameters of joy_node: from a dict to a checked, frozen dataclass (pure).

Names, meanings and defaults are those of ROS Noetic's package joy, but for autorepeat_rate, which
is 0 there: a node that stops the robot on silence needs a held stick to be repeated.
"""

from dataclasses import dataclass, field, fields

from joy_to_twist.parameters import check, flag, number


def _text(default, allowed):
    return field(
        default=default, metadata={"valid": lambda v: isinstance(v, str), "allowed": allowed}
    )


@dataclass(frozen=True)
class DriverParameters:
    """All parameters of the driver. Units: s, Hz; deadzone as a part of an axis' way."""

    dev: str = field(
        default="/dev/input/js0",
        metadata={
            "valid": lambda v: isinstance(v, str) and v.startswith("/"),
            "allowed": "a whole path, such as /dev/input/js0",
        },
    )
    dev_name: str = _text("", "the name of a gamepad, or a part of it, or nothing")
    dev_ff: str = _text("", "the path of a device, which is not used")  # upstream's, for rumble
    deadzone: float = number(0.05, 0, 1, "a number from 0 to 1")
    autorepeat_rate: float = number(20.0, 0, 1000, "a number of Hz from 0 (off) to 1000")
    coalesce_interval: float = number(0.001, 0, 10, "a number of seconds from 0 to 10")
    default_trig_val: bool = flag(False)
    sticky_buttons: bool = flag(False)
    diagnostic_period: float = number(1.0, 0.1, 60, "a number of seconds from 0.1 to 60")


def load(given):
    """Check the given private parameters and fill in the defaults.

    Raises ValueError, one line that names the parameter, its value and what is allowed.
    """
    known = {f.name: f for f in fields(DriverParameters)}
    unknown = sorted(set(given) - set(known))
    if unknown:
        names = ", ".join(sorted(known))
        raise ValueError(f"There is no parameter ~{unknown[0]}; the parameters are {names}.")
    for name, value in given.items():
        metadata = known[name].metadata
        check(metadata["valid"](value), name, value, metadata["allowed"])
    return DriverParameters(**given)
