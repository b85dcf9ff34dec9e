"""One line about a drive."""

import math

from tutorial_tools.demo.drive_report import DriveReport


def test_messages_way_and_final_pose():
    report = DriveReport(("/joy", "/odom"))
    assert report.line(1.5) == "1.5 s: 0 /joy, 0 /odom; no pose"
    for x_m, y_m, yaw_deg in ((0, 0, 0), (0, 0, 0), (3, 4, 5), (3, 3, 270)):
        half = math.radians(yaw_deg) / 2
        report.add_pose(x_m, y_m, math.sin(half), math.cos(half))
    report.counts["/joy"] += 2
    assert report.moved
    counted = "20.0 s: 2 /joy, 0 /odom; driven 6.00 m"
    assert report.line(20) == f"{counted}; final pose x 3.00 m, y 3.00 m, yaw -90.0 deg"
