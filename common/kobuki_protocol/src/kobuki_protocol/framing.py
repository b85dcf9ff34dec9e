"""Packets on the serial line of a Kobuki, and how to find them in a stream of bytes.

A packet is a header, the length of its payload, the payload and a checksum; the payload is a
sequence of parts, each with its id and length. All numbers are little-endian.
"""

from __future__ import annotations

import struct
from contextlib import suppress
from functools import reduce
from operator import xor
from typing import Callable, Iterator, Mapping, Tuple, TypeVar

HEADER = b"\xaa\x55"
PREFIX = len(HEADER) + 1  # bytes before a payload: the header and its length
LONGEST_PAYLOAD = 255
Part = Tuple[int, bytes]  # id and data
DAMAGED, INCOMPLETE = 0, -1
_Parsed = TypeVar("_Parsed")


def packet(payload: bytes) -> bytes:
    """Return a payload as a packet; the exclusive or of all bytes after the header is 0."""
    body = bytes([len(payload)]) + payload
    return HEADER + body + bytes([reduce(xor, body)])


def part(number: int, data: bytes) -> bytes:
    """Return a part of a payload: its id, the length of its data, and the data."""
    return bytes([number, len(data)]) + data


def split(payload: bytes) -> Iterator[Part]:
    """Yield the id and the data of each part of a payload from the Framer."""
    start = 0
    while start + 1 < len(payload):
        end = start + 2 + payload[start + 1]
        yield payload[start], payload[start + 2 : end]
        start = end


def parse_parts(payload: bytes, parsers: Mapping[int, Callable[[bytes], _Parsed]]) -> list[_Parsed]:
    """Return the parts of a payload, without those of an unknown id or length."""
    parsed = []
    for number, data in split(payload):
        if number in parsers:
            with suppress(struct.error):
                parsed.append(parsers[number](data))
    return parsed


class Framer:
    """Finds the packets in a stream of bytes, which may be damaged anywhere.

    A packet begins with a header, its parts fill its length, and its checksum is right. If one of
    these fails, the search for the next header continues inside the failed packet, so that damage
    never hides an intact one.
    """

    def __init__(self) -> None:
        """Start with an empty stream."""
        self._waiting = bytearray()
        self.damaged = 0  # headers without a valid packet
        self.skipped = 0  # bytes outside of packets

    def feed(self, data: bytes) -> list[bytes]:
        """Add the next bytes; return the payloads of the packets that they complete."""
        waiting, payloads = self._waiting, []
        waiting += data
        start = done = 0  # done: the end of the last packet
        while (start := waiting.find(HEADER, start)) >= 0:
            end = _end_of_packet(waiting, start)
            if end == INCOMPLETE:
                break
            if end == DAMAGED:
                self.damaged += 1
                start += 1
                continue
            self.skipped += start - done
            payloads.append(bytes(waiting[start + PREFIX : end - 1]))
            start = done = end
        if start < 0:  # the last byte may be half a header
            start = len(waiting) - waiting.endswith(HEADER[:1])
        self.skipped += max(0, start - done)
        del waiting[: max(start, done)]
        return payloads

    def reset(self) -> None:
        """Discard an incomplete packet, which the next bytes do not continue."""
        self.skipped += len(self._waiting)
        self._waiting.clear()


def _end_of_packet(data: bytearray, start: int) -> int:
    """Return the end of the packet that begins at start, or DAMAGED, or INCOMPLETE."""
    if len(data) < start + PREFIX:
        return INCOMPLETE
    stop = start + PREFIX + data[start + PREFIX - 1]
    position = _end_of_parts(data, start + PREFIX, stop)
    if position > stop or stop == start + PREFIX:
        return DAMAGED
    if position < stop or len(data) <= stop:
        return INCOMPLETE
    return DAMAGED if reduce(xor, data[start + 2 : stop + 1]) else stop + 1


def _end_of_parts(data: bytearray, position: int, stop: int) -> int:
    """Return the end of the last part that has started: stop if the parts fill the payload.

    It is less if bytes are missing, and more if the parts do not fit.
    """
    while position < stop:
        if position + 1 == stop:
            return stop + 1  # an id without a length
        if position + 1 >= len(data):
            break
        position += 2 + data[position + 1]
    return position
