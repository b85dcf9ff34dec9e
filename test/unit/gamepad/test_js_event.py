"""The events of a joystick device: from bytes and to bytes."""

from hypothesis import given
from hypothesis import strategies as st

from gamepad.js_event import Decoder


@given(st.lists(st.binary(max_size=20)))
def test_reads_may_be_cut_anywhere(pieces):
    decoder = Decoder()
    one_by_one = [event for piece in pieces for event in decoder.feed(piece)]
    assert one_by_one == Decoder().feed(b"".join(pieces))
