"""Curves of recordings, and which topics are played together."""

import pytest

from cockpit_server.errors import RefusedError
from cockpit_server.tabs.recordings import MOST_KEPT, MOST_POINTS, Curve, Shelf, corners, playable
from tutorial_testing.claims import claim

TYPES = {"/joy": "sensor_msgs/Joy", "/pad/joy": "sensor_msgs/Joy", "/odom": "nav_msgs/Odometry"}


@claim("A curve of a long recording is thinned and keeps its peaks")
@pytest.mark.parametrize("count", [1, 10, 999, 100_000])
def test_thinned_curve_keeps_its_ends_and_a_peak_of_one_message(count):
    curve = Curve(count)
    for i in range(count):
        curve.add(i, 1000.0 if i == count // 2 else i % 7)
    points = curve.points()
    assert len(points) <= MOST_POINTS and len(points) >= min(count, MOST_POINTS // 2)
    assert [t for t, _ in points] == sorted(t for t, _ in points)
    assert [count // 2, 1000.0] in points


def test_points_inside_a_horizontal_line_are_left_out():
    assert corners([[0, 1], [1, 1], [2, 1], [3, 2], [4, 1]]) == [[0, 1], [2, 1], [3, 2], [4, 1]]


def test_the_recordings_that_were_opened_last_are_kept():
    shelf, read = Shelf(), []
    for file in (*range(MOST_KEPT), 0, MOST_KEPT, 0, 1):
        shelf.take(file, lambda file=file: read.append(file) or f"recording {file}")
    assert read == [*range(MOST_KEPT), MOST_KEPT, 1]


@claim("Only topics that fit together are played")
@pytest.mark.parametrize(
    ("topics", "published", "why"),
    [
        (["/odom", "/joy"], {}, ""),
        (["/joy"], {"/joy": "std_msgs/String"}, ""),  # the joystick of the robot in sight
        ([], {}, "choose a topic"),
        (["/scan"], {}, "no topic '/scan'"),
        (["/joy", "/pad/joy"], {}, "one joystick"),
        (["/odom"], {"/odom": "std_msgs/String"}, "/odom has the type std_msgs/String here"),
    ],
)
def test_topics_are_played_that_fit_the_recording_and_the_graph(topics, published, why):
    if why:
        with pytest.raises(RefusedError, match=why):
            playable(TYPES, topics, published)
    else:
        assert playable(TYPES, topics, published) == {topic: TYPES[topic] for topic in topics}
