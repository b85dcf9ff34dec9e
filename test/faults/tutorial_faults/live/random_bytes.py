"""Random bytes that look like Joy messages or like events of a gamepad, more or less (pure)."""

import math
import struct
from random import Random

LB, RB = 4, 5
# Values of an axis that have broken something somewhere.
ODD = (math.nan, math.inf, -math.inf, 0.0, -0.0, 1.0, -1.0, 1e38, -1e38, 1e-45, 2.0, 1e6)
_LENGTH = struct.Struct("<I")


def random_bytes(random: Random, count):
    """So many random bytes."""
    return random.getrandbits(8 * count).to_bytes(count, "little") if count else b""


def joy(random: Random, may_hold):
    """A Joy as it goes over the wire, with its length before it.

    Any number of axes and buttons, any values. may_hold: whether LB or RB may be held.
    """
    axes = random.choice((6, 6, 6, 8, 0, 1, 2, random.randrange(40)))
    if random.random() < 0.5:
        values = [random.uniform(-1, 1) for _ in range(axes)]
        if values and random.random() < 0.3:
            values[random.randrange(axes)] = random.choice(ODD)
        packed = struct.pack(f"<{axes}f", *values)
    else:
        packed = random_bytes(random, 4 * axes)
    buttons = [
        random.choice((0, 1, 1, -1, 2**31 - 1)) for _ in range(random.choice((12, 12, 11, 5, 0)))
    ]
    if not may_hold:
        for number in (LB, RB):
            buttons[number : number + 1] = [0] * len(buttons[number : number + 1])
    frame = random_bytes(random, random.choice((0, 0, 5, 60)))
    return _framed(
        random_bytes(random, 12)
        + _LENGTH.pack(len(frame)) + frame
        + _LENGTH.pack(axes) + packed
        + struct.pack(f"<I{len(buttons)}i", len(buttons), *buttons)
    )  # fmt: skip


def broken_joy(random: Random):
    """A Joy that cannot be read: cut, with a number that lies, oversized, or noise."""
    whole = joy(random, may_hold=True)[4:]
    way = random.randrange(5)
    if way == 0:
        return _framed(whole[: random.randrange(len(whole))])
    if way == 1:
        return _framed(whole[:12] + _LENGTH.pack(random.randrange(10**6, 2**32)) + whole[16:])
    if way == 2:
        return _framed(random_bytes(random, random.randrange(200)))
    if way == 3:
        return _framed(whole + random_bytes(random, 100_000))
    return _LENGTH.pack(random.randrange(2**32)) + whole  # a length before it that lies


def events(random: Random, count):
    """Bytes for a gamepad's device: so many events, with any numbers, or nothing but noise."""
    if random.random() < 0.3:
        return random_bytes(random, 8 * count + random.randrange(8))
    kinds = (1, 2, 0x81, 0x82)
    return b"".join(
        struct.pack(
            "=IhBB", random.getrandbits(32), random.randrange(-(2**15), 2**15),
            random.choice(kinds), random.randrange(12),
        )
        for _ in range(count)
    )  # fmt: skip


def _framed(body):
    return _LENGTH.pack(len(body)) + body
