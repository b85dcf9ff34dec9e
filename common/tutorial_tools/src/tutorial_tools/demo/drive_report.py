"""What was driven: messages, distance, pose."""

from __future__ import annotations

import math


class DriveReport:
    """A drive; poses are in metres and radians, in the frame of the odometry."""

    MOVED_M = 0.001  # less than this is a robot at rest

    def __init__(self, topics: tuple[str, ...]) -> None:
        """topics: the names whose messages are counted, in the order of the report."""
        self.counts = dict.fromkeys(topics, 0)
        self.distance_m = 0.0
        self.pose: tuple[float, float, float] | None = None

    def add_pose(self, x_m: float, y_m: float, qz: float, qw: float) -> None:
        """Continue to a new pose; qz and qw are the parts of a quaternion about the z axis."""
        if self.pose is not None:
            self.distance_m += math.hypot(x_m - self.pose[0], y_m - self.pose[1])
        self.pose = (x_m, y_m, 2 * math.atan2(qz, qw))

    @property
    def moved(self) -> bool:
        """Return whether the robot drove at all."""
        return self.distance_m > self.MOVED_M

    def line(self, duration_s: float) -> str:
        """Return the drive in one line."""
        counted = ", ".join(f"{count} {topic}" for topic, count in self.counts.items())
        if self.pose is None:
            return f"{duration_s:.1f} s: {counted}; no pose"
        x_m, y_m, yaw_rad = self.pose
        yaw_deg = math.degrees(math.remainder(yaw_rad, 2 * math.pi))
        return (
            f"{duration_s:.1f} s: {counted}; driven {self.distance_m:.2f} m; "
            f"final pose x {x_m:.2f} m, y {y_m:.2f} m, yaw {yaw_deg:.1f} deg"
        )
