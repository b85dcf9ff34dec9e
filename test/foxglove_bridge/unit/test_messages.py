"""Bytes that are a message, or are not."""

from geometry_msgs.msg import Twist
from nav_msgs.msg import Path
from std_msgs.msg import Empty, String

from foxglove_bridge_server.messages import fits, serialised
from tutorial_testing.claims import claim

pytestmark = claim("Bytes of a client that are no message of the topic's type reach no subscriber")


def test_whole_messages_fit():
    for message in (Twist(), String("ä"), Empty(), Path()):
        assert fits(serialised(message), type(message))


def test_what_is_cut_off_too_long_or_of_another_type_does_not_fit():
    twist = serialised(Twist())
    for data in (b"", twist[:-1], twist + b"\0", b"\xff\xff\xff\xff"):
        assert not fits(data, Twist)
    for data in (b"", b"\xff\xff\xff\xff", b"\5\0\0\0abc", b"\1\0\0\0\xff"):
        assert not fits(data, String)
    assert not fits(b"\xff" * 20, Path)
