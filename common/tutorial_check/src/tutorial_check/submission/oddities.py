"""What a C++ compiler accepts, and a node does not survive."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Tuple, Union

Place = Union[Tuple[int, str], Tuple[()]]  # (line, text), or empty


class LostSubscriber(NamedTuple):
    """A Subscriber that ends before a message comes."""

    line: int
    name: str  # "": it is not kept at all
    ends_with: str  # the function that it is local to, or "a block"
    hides: bool  # a member or global variable of that name


class OddIndex(NamedTuple):
    """A constant index, such as that of msg->axes[6]."""

    line: int
    array: str
    number: int


@dataclass(frozen=True)
class Oddities:
    """The oddities of a program; in Python there are none."""

    lost_subscriber: LostSubscriber | None = None
    hidden_publisher: Place = ()  # a local variable with the name of a member or global one
    unmade_publisher: Place = ()  # the first publish of a Publisher that no advertise makes
    function_declared: Place = ()  # `Node node();` declares a function, and makes no Node
    private: tuple[tuple[str, int], ...] = ()  # (Publisher or Subscriber, line of its "~")
    whole_division: Place = ()  # of two whole numbers, with a rest
    whole_axis: Place = ()  # an axis that becomes a whole number
    indices: tuple[OddIndex, ...] = ()  # of axes and buttons
    unset_pointer: Place = ()  # the first use of a pointer that is never set


@dataclass(frozen=True)
class Lapses:
    """What a program in C++ does too early, too late or never: lines, or 0."""

    early_handle: Place = ()  # (line, fix): a NodeHandle before ros::init
    text_as_object: Place = ()  # a std::string for %s, without c_str()
    bare_ok: int = 0  # the line of ros::ok without ()
    late_subscriber: int = 0  # the line of a subscribe that comes after ros::spin
    late_loop: int = 0  # the line of a loop that comes after ros::spin
    repeated_publisher: int = 0  # the line of advertise in a loop
    unended_line: int = 0  # the line of an output without std::endl
    looped_spin: int = 0  # the line of ros::spin() in a loop that does more
    empty_loop: int = 0  # the line of `while (...);`
