"""Subscriptions to the topics that pages show."""

from types import SimpleNamespace

from cockpit_server.ros import feeds
from tutorial_testing.claims import claim


def test_refused_topic_does_not_hold_up_the_others_and_many_changes_are_one(monkeypatch):
    waiting, subscribed = [], set()  # calls to the master; (topic, whether all messages are wanted)

    class Subscriber:
        """Replaces rospy's; refuses topics without a slash."""

        def __init__(self, topic, _kind, _hear, _topic, queue_size):
            if not topic.startswith("/"):
                raise ValueError("no topic")
            self.key = topic, queue_size is None
            subscribed.add(self.key)

        def unregister(self):
            subscribed.remove(self.key)
            raise OSError("the master")

    monkeypatch.setattr(feeds, "later", waiting.append)
    monkeypatch.setattr(feeds.rospy, "Subscriber", Subscriber)
    lines = []
    all_feeds = feeds.Feeds(lines.append)
    topics = ["", *(f"/t{i}" for i in range(20)), "x"]  # in a set, so that some come after ""
    for every in (True, False, True):
        for wanted in ("/earlier", *topics):
            all_feeds.set_subscriptions("page", {wanted: print}, every=True)
        all_feeds.set_subscriptions("page", dict.fromkeys(topics, print), every=every)
        waiting.pop()()
        assert (waiting, subscribed) == ([], {(topic, every) for topic in topics[1:-1]})
    assert len(lines) == len(topics)  # one each: two are refused, the others fail
    assert sum("ValueError" in line for line in lines) == 2


@claim("Floor: map, scan and bumpers ...", because="latched transforms")
def test_topic_that_is_dropped_and_wanted_again_brings_what_is_latched(monkeypatch):
    waiting, made = [], []
    monkeypatch.setattr(feeds, "later", waiting.append)
    subscriber = SimpleNamespace(unregister=lambda: None)
    monkeypatch.setattr(
        feeds.rospy, "Subscriber", lambda topic, *_: made.append(topic) or subscriber
    )
    all_feeds = feeds.Feeds(print)
    for _ in range(2):  # The second time the page goes from one tab that needs it to another one.
        all_feeds.set_subscriptions("page", {}, every=True)
        all_feeds.set_subscriptions("page", {"/tf_static": print}, every=True)
        waiting.pop()()
        assert not waiting
    all_feeds.set_subscriptions("another", {"/odom": print}, every=True)
    waiting.pop()()
    assert made == ["/tf_static", "/tf_static", "/odom"]
