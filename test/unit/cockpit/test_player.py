"""When which recorded message is due."""

from cockpit_server.player import Player

MESSAGES = [(0.0, "a", 0), (0.5, "b", 0), (1.0, "c", 0)]


def player(position=0.0, rate=1.0, loop=False):
    one = Player(MESSAGES, 1.2, rate, loop)
    one.seek(position, 10.0)
    return one


def names(due):
    return "".join(axes for axes, _ in due)


def test_each_message_once_at_its_time():
    one = player()
    assert names(one.due(10.01)) == "a"
    assert names(one.due(10.49)) == ""
    assert names(one.due(10.51)) == "b"
    assert names(one.due(11.3)) == "c"
    assert one.is_over(11.3) and not one.is_over(11.1)
    assert one.position(10.75) == 0.75


def test_faster_and_slower():
    assert names(player(rate=2.0).due(10.3)) == "ab"
    assert names(player(rate=0.5).due(10.9)) == "a"


def test_from_a_position_on():
    assert names(player(position=0.5).due(10.1)) == "b"
    one = player()
    one.due(10.1)
    one.seek(0.9, 10.1)
    assert names(one.due(10.25)) == "c"


def test_the_end_begins_anew():
    one = player(loop=True)
    assert names(one.due(11.19)) == "abc"
    assert names(one.due(11.21)) == ""
    assert names(one.due(11.22)) == "a"
    assert not one.is_over(100.0)
    assert names(player(position=5.0).due(10.1)) == "a"  # beyond the end: from the beginning
