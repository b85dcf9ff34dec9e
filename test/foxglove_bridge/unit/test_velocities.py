"""Who drives a topic of velocities."""

from foxglove_bridge_server.velocities import OTHERS_S, SILENCE_S, VelocityTopic
from tutorial_testing.claims import claim

pytestmark = claim("A velocity of a client is ended ...", because="each rule, with exact times")
AHEAD, ZERO = bytes(40) + b"\0\0\0\0\0\0\xf0?", bytes(48)
STAMPED = b"\1\0\0\0\5\0\0\0\0\0\0\0\0\0\0\0"  # a header
NOW = 100.0
ONE, TWO = (1, 7), (2, 7)  # clients


def driven(data=AHEAD):
    topic = VelocityTopic()
    topic.command(ONE, data, NOW)
    return topic


def test_a_zero_is_due_once_when_the_driver_is_gone_and_for_no_one_else():
    topic = driven()
    assert not topic.is_zero_due(NOW, gone=TWO)
    assert topic.is_zero_due(NOW, gone=ONE)
    assert not topic.is_zero_due(NOW, gone=ONE)


def test_a_zero_is_due_once_after_silence():
    topic = driven()
    assert not topic.is_zero_due(NOW + SILENCE_S)
    assert topic.is_zero_due(NOW + SILENCE_S + 0.01)
    assert not topic.is_zero_due(NOW + SILENCE_S + 0.02)


def test_after_a_zero_of_the_client_none_is_due_with_or_without_a_header():
    for data in (ZERO, STAMPED + ZERO):
        topic = driven(data)
        assert not topic.is_zero_due(NOW + 100.0, gone=ONE)
        assert not topic.refusal(TWO, NOW)
    assert driven(STAMPED + AHEAD).is_zero_due(NOW, gone=ONE)


def test_another_client_is_refused_until_the_motion_has_ended():
    topic = driven()
    assert topic.refusal(TWO, NOW) == "another client drives: stop it, then wait 2 s"
    assert not topic.refusal(ONE, NOW)
    assert topic.is_zero_due(NOW, gone=ONE)
    assert not topic.refusal(TWO, NOW)


def test_a_node_takes_the_topic_for_a_second_after_each_message_and_gets_no_zero():
    topic = driven()
    topic.hear("/joy2twist", NOW)
    for client in (ONE, TWO):
        refusal = topic.refusal(client, NOW + OTHERS_S - 0.01)
        assert refusal == "/joy2twist publishes there: stop it, then wait 1 s"
        assert not topic.refusal(client, NOW + OTHERS_S)
    assert not topic.is_zero_due(NOW + 100.0, gone=ONE)
