"""Rates of topics, and the newest messages as text."""

import pytest
from std_msgs.msg import String

from cockpit_server.graph import Graph
from cockpit_server.messages import ReceivedMessage
from cockpit_server.tabs import topics
from tutorial_testing.session_room import Graphs, Topics, look, page, serialised


@pytest.mark.parametrize("rate", [0.5, 3.0, 10.0, 1000.0])
def test_rate_is_right_while_messages_come_and_0_once_they_do_not(rate):
    topic, measured_at = topics.MeasuredTopic(), 0.0
    for n in range(int(8 * rate) + 2):
        now = 50 + n / rate
        topic.add(ReceivedMessage("/x", bytes(100), "/n", now))
        if now - measured_at > topics.PERIOD_S:
            measured_at = now
            topic.measure("", now)
    assert (topic.rate, topic.bytes_per_s) == pytest.approx((rate, 100 * rate), rel=0.001)
    topic.measure("", now + max(2.0, 3 / rate) + 0.1)
    assert topic.rate == 0


def test_page_gets_the_newest_messages_of_its_topic_once_and_the_rates_of_those_in_sight():
    graph = Graph(publishers={"/x": {"/n"}}, types={"/x": "std_msgs/String", "/y": "no/Type"})
    feeds = Topics()
    source = topics.Topics(feeds, Graphs(graph))
    first, second = (page(topic="/x", rates=("/x", "/y", "/z")) for _ in range(2))

    def shown(*pages, now):
        sent = [message for part in look(source, *pages, now=now) for message in part[1:]]
        return [[text for _, text in message["echo"]] for message in sent]

    assert shown(first, now=1.0) == []
    assert set(feeds.handlers) == {"/x", "/y"}
    for text in "abcd":
        feeds.hear("/x", String(text))
    assert shown(first, now=2.0) == [['data: "b"', 'data: "c"', 'data: "d"']]
    assert shown(first, second, now=3.0) == [['data: "b"', 'data: "c"', 'data: "d"']]
    [rates] = look(source, first, now=4.0)[0]
    assert set(rates["rates"]) == {"/x", "/y", "/z"}


def test_long_message_is_shown_by_its_length():
    for length, text in ((19_996, 'data: "xxx'), (20_000, "(20004 bytes)")):
        assert topics.text(serialised(String("x" * length)), "std_msgs/String").startswith(text)
