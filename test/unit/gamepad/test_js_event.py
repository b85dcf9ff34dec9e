"""The events of a joystick device: from bytes and to bytes."""

from hypothesis import given
from hypothesis import strategies as st

from gamepad.js_event import Decoder, JsEvent, pack


def test_an_event_is_read_field_by_field():
    assert Decoder().feed(bytes.fromhex("78563412 0180 02 05")) == [
        JsEvent(time_ms=0x12345678, value=-32767, type=2, number=5)
    ]


@given(st.lists(st.binary(max_size=20)))
def test_reads_may_be_cut_anywhere(pieces):
    decoder = Decoder()
    one_by_one = [event for piece in pieces for event in decoder.feed(piece)]
    assert one_by_one == Decoder().feed(b"".join(pieces))


@given(st.binary())
def test_bytes_to_events_and_back(data):
    assert b"".join(map(pack, Decoder().feed(data))) == data[: len(data) - len(data) % 8]
