"""The line in which the demonstration tells what was driven."""

import math

from tutorial_tools.demo.drive_report import DriveReport


def drive(*poses):
    report = DriveReport(("/joy", "/odom"))
    for x_m, y_m, yaw_rad in poses:
        report.add_pose(x_m, y_m, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2))
    return report


def test_counts_way_and_final_pose():
    report = drive((0, 0, 0), (3, 4, 0.1), (3, 3, math.radians(90)))
    for topic in ("/joy", "/joy", "/odom"):
        report.count(topic)
    assert report.distance_m == 6.0
    assert report.moved
    assert report.line(20) == (
        "20.0 s: 2 /joy, 1 /odom; driven 6.00 m; final pose x 3.00 m, y 3.00 m, yaw 90.0 deg"
    )


def test_where_it_starts_is_no_way():
    report = drive((5, 5, 0), (5, 5, 0))
    assert report.distance_m == 0
    assert not report.moved


def test_yaw_is_told_within_half_a_turn():
    assert "yaw -90.0 deg" in drive((0, 0, math.radians(270))).line(1)


def test_a_robot_that_was_not_seen():
    report = drive()
    assert not report.moved
    assert report.line(1.5) == "1.5 s: 0 /joy, 0 /odom; no pose"
