"""How the topics of a recording are published."""

from cockpit_server.ros.tabs import playback
from cockpit_server.ros.tabs.recorded_types import Connection
from tutorial_testing.claims import claim


@claim("Recorded messages are published equal ...", because="which are latched")
def test_a_latched_topic_is_latched_unless_it_is_a_velocity(monkeypatch):
    made = []
    for name in ("Queued", "PromptPublisher"):
        publisher = lambda *_, name=name, **how: made.append((name, how.get("latch")))  # noqa: E731
        monkeypatch.setattr(playback, name, publisher)
    for kind, latching in (("x/y", "1"), ("x/y", "0"), ("geometry_msgs/Twist", "1")):
        playback.output_of(Connection("/x", kind, "0" * 32, "", {"latching": latching}))
    assert made == [("Queued", True), ("Queued", False), ("PromptPublisher", None)]
