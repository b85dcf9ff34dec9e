"""The framer finds the next packet after any damage to the stream."""

import random
from collections import Counter

import pytest

from kobuki_protocol.framing import Framer, packet
from tutorial_testing.claims import claim

pytestmark = claim("After any damage of the stream each whole packet is delivered, and no other")
STREAMS = 10_000
PACKETS = 6
BASE_CONTROL = bytes.fromhex("aa 55 06 01 04 64 00 00 00 67")
PAYLOAD = BASE_CONTROL[3:-1]


def payload(values):
    """Return one to three parts; some have a header in their data."""
    parts = []
    for _ in range(values.randint(1, 3)):
        data = bytes(values.getrandbits(8) for _ in range(values.randint(0, 20)))
        if values.random() < 0.1:
            data += b"\xaa\x55" + data
        parts.append(bytes([values.getrandbits(8), len(data)]) + data)
    return b"".join(parts)


def damaged(values, stream):
    """Return the stream with one damaged place, and where it is in the original: (start, end)."""
    start = values.randrange(len(stream))
    end = min(len(stream), start + values.randint(1, 30))
    kind = values.choice(["flip", "lose", "twice", "garbage", "cut"])
    if kind == "cut":
        return stream[start:], (0, start)
    if kind == "flip":
        end = start + 1
        changed = bytes([stream[start] ^ (1 << values.randrange(8))])
    else:
        likely = [0xAA, 0x55, 0, 255, values.getrandbits(8)]
        garbage = bytes(values.choice(likely) for _ in range(20))
        changed = {"lose": b"", "twice": stream[start:end] * 2}.get(kind, garbage)
    return stream[:start] + changed + stream[end:], (start, end)


def in_pieces(values, stream):
    while stream:
        length = values.choice([1, 2, 7, 64, 300])
        yield stream[:length]
        stream = stream[length:]


def test_every_undamaged_packet_is_delivered_and_no_other():
    """A false packet needs parts that fill it and a checksum that matches by chance."""
    values = random.Random(427)
    false = 0
    for _ in range(STREAMS):
        sent = [payload(values) for _ in range(PACKETS)]
        stream, places = b"", []
        for part in sent:
            places.append((len(stream), len(stream) + len(part) + 4))
            stream += packet(part)
        stream, (start, end) = damaged(values, stream)
        stream += packet(b"\x01\x00") * 130  # a false length can swallow 255 bytes
        framer, received = Framer(), []
        for piece in in_pieces(values, stream):
            received += framer.feed(piece)
        whole = Counter(part for part, (a, b) in zip(sent, places) if b <= start or a >= end)
        lost, rest = whole - Counter(received), Counter(received) - whole
        strange = [part for part in rest.elements() if part not in (b"\x01\x00", *sent)]
        false += len(strange)
        assert not lost or strange, (sent, received)
    assert false <= STREAMS / 500


def test_a_packet_is_delivered_with_its_last_byte():
    framer = Framer()
    assert framer.feed(BASE_CONTROL[:-1]) == []
    assert framer.feed(BASE_CONTROL[-1:]) == [PAYLOAD]
    assert (framer.damaged, framer.skipped) == (0, 0)


@pytest.mark.parametrize(("before", "damage", "skipped"), [
    ("00 " * 100, 0, 100),  # a line held low
    ("aa aa aa", 0, 3),
    ("aa 55 00", 1, 3),  # no payload
    ("aa 55 06 01 04 64 00 00 00 66", 1, 10),  # a wrong checksum
    ("aa 55 06 01 04 64 00", 1, 7),  # cut off: its length reaches into the next packet
    ("aa 55 aa 01 04", 1, 5),  # length 170 (kobuki 382)
    ("aa 55 05 01 02 03 04 09", 1, 8),  # parts longer than the payload
])  # fmt: skip
def test_what_is_no_packet_costs_only_itself(before, damage, skipped):
    framer = Framer()
    received = framer.feed(bytes.fromhex(before) + BASE_CONTROL * 30)
    assert received == [PAYLOAD] * 30
    assert (framer.damaged, framer.skipped) == (damage, skipped)


def test_a_false_length_does_not_hold_up_what_follows():
    """The second byte of the next header is no valid length, so it is rejected at once."""
    framer = Framer()
    assert framer.feed(bytes.fromhex("aa 55 20 01 02 64 00") + BASE_CONTROL) == [PAYLOAD]


def test_a_packet_that_was_cut_off_by_silence_is_forgotten():
    framer = Framer()
    framer.feed(BASE_CONTROL[:5])
    framer.reset()
    assert framer.feed(BASE_CONTROL) == [PAYLOAD]
    assert framer.skipped == 5
