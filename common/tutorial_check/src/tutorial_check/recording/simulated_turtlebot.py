"""The simulated TurtleBot, started by the checker and driven by a student's program."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

from tutorial_check.errors import CannotCheck
from tutorial_check.processes.started_program import Program
from tutorial_check.recording.ros_session import START_S, RosSession

BUMPER, TRUTH = "/mobile_base/events/bumper", "/base_pose_ground_truth"
ODOM = "/odom"  # in an empty plane it is the true pose
LONGEST_DRIVE_S = 20.0
NEWEST = 50  # samples, from one second


@dataclass(frozen=True)
class PoseSample:
    """A sample of the robot's path: stamp [s], pose [m, rad], velocity [m/s, rad/s]."""

    at_s: float
    x: float
    y: float
    yaw: float
    v: float
    w: float


class SimulatedTurtleBot:
    """A robot that follows /cmd_vel, and its path."""

    def __init__(self, ros: RosSession, *arguments: str) -> None:
        """Start it, with parameters such as _world:=room or _initial_x:=1.0. Raises CannotCheck."""
        self._ros = ros
        self._poses = TRUTH if any("_world:=" in word for word in arguments) else ODOM
        ros.peer.listen(self._poses, "Odometry")
        ros.peer.listen(BUMPER, "BumperEvent")
        robot = ros.start_ours("fake_turtlebot_sim", "fake_turtlebot.py", *arguments)
        ros.wait(lambda: robot.ended or ros.peer.count(self._poses), START_S)
        if robot.ended or not ros.peer.count(self._poses):
            raise CannotCheck(f"the simulated robot does not start: {robot.output[-200:]}")

    @property
    def path(self) -> tuple[PoseSample, ...]:
        """Its path so far, with 50 samples a second."""
        return tuple(map(_sample, self._ros.peer.received(self._poses)))

    @property
    def moves(self) -> bool:
        """Whether it moved within the last second."""
        count = self._ros.peer.count(self._poses)
        newest = self._ros.peer.received(self._poses, max(0, count - NEWEST))
        return has_moved(tuple(map(_sample, newest)))

    @property
    def bumps(self) -> int:
        """How many times a bumper was pressed or released."""
        return int(self._ros.peer.count(BUMPER))

    def drive(self, program: Program, longest_s: float = LONGEST_DRIVE_S) -> tuple[PoseSample, ...]:
        """Wait until it has moved and rested for a second, or for longest_s; return its path."""
        self._ros.wait(lambda: program.ended or self.moves, START_S)
        if self.moves:
            self._ros.wait(lambda: not self.moves, longest_s)
        return self.path


def has_moved(path: Sequence[PoseSample]) -> bool:
    return any(sample.v or sample.w for sample in path)


def _sample(received: tuple[float, str, Sequence[float]]) -> PoseSample:
    at_s, x, y, sine, cosine, v, w = received[2]
    return PoseSample(at_s, x, y, 2.0 * math.atan2(sine, cosine), v, w)
