"""Subscriptions to what is looked at."""

import pytest

from cockpit_server import feeds


class Subscriber:
    """In rospy's place, which refuses "" and topics that it does not know how to name."""

    def __init__(self, topic, *_):
        if not topic.startswith("/"):
            raise ValueError("no topic")

    def unregister(self):
        raise OSError("the master")


@pytest.fixture
def waiting(monkeypatch):
    """What waits for the master's thread."""
    actions = []
    monkeypatch.setattr(feeds.rospy, "Subscriber", Subscriber)
    monkeypatch.setattr(feeds, "later", actions.append)
    return actions


def test_a_refused_topic_does_not_hold_up_the_others(waiting):
    told = []
    all_feeds = feeds.Feeds(told.append)
    topics = ["", *(f"/t{i}" for i in range(20)), "x"]  # in a set, so that some come after ""
    for every in (True, False, True):
        all_feeds.want("page", dict.fromkeys(topics, print), every=every)
        waiting.pop()()
        assert set(all_feeds._subscribers) == {(topic, every) for topic in topics[1:-1]}
    assert len(told) == len(topics)  # of each once: two are refused, the others do not end well
    assert sum("ValueError" in line for line in told) == 2


def test_many_changes_queue_one_adjustment(waiting):
    all_feeds = feeds.Feeds(print)
    for number in range(1000):
        all_feeds.want("page", {f"/t{number}": print}, every=True)
    assert len(waiting) == 1
    waiting.pop()()
    assert set(all_feeds._subscribers) == {("/t999", True)}
    all_feeds.want("page", {"/t1": print}, every=True)
    assert len(waiting) == 1
