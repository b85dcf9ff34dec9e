"""Subscriptions to the topics that pages show."""

from cockpit_server.ros import feeds


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
