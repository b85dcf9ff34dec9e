"""Real and simulated time behind one interface, and the lock of the motion that follows it.

``read()`` returns (stamp, reading): the ROS time for messages, and the time in nanoseconds for
motion and periods. ``wait(reading, deadline)`` returns once the clock has reached the deadline, was
set back behind the reading, or the node is shut down.
"""

from __future__ import annotations

import threading
import time
from contextlib import contextmanager
from typing import Iterator, NamedTuple

import rospy

from fake_turtlebot_sim.simulator.clock import MotionClock
from node_kit.io.suspension import Suspensions

SHUTDOWN_CHECK_S = 0.1  # longest delay of a shutdown while /clock is paused


class RealClock:
    """Stamps from the system clock; motion from the monotonic clock, which cannot be set."""

    def read(self) -> tuple[rospy.Time, int]:
        return rospy.Time.now(), time.monotonic_ns()

    def wait(self, _reading_ns: int, deadline_ns: int) -> None:
        time.sleep(max(0, deadline_ns - time.monotonic_ns()) * 1e-9)


class SimulatedClock:
    """Stamps and motion from /clock, which may pause, jump forwards and be set back."""

    def read(self) -> tuple[rospy.Time, int]:
        stamp = rospy.Time.now()
        return stamp, stamp.to_nsec()

    def wait(self, reading_ns: int, deadline_ns: int) -> None:
        changed = rospy.rostime.get_rostime_cond()
        with changed:
            while (
                reading_ns <= rospy.Time.now().to_nsec() < deadline_ns and not rospy.is_shutdown()
            ):
                changed.wait(SHUTDOWN_CHECK_S)


class Instant(NamedTuple):
    """A reading of the node's three clocks."""

    stamp: rospy.Time
    reading_ns: int
    motion_ns: int  # never decreases


class MotionLock:
    """The lock for the motion of all robots; only the thread that holds it may move them."""

    def __init__(self) -> None:
        """Use the clock that /use_sim_time selects; the node must be initialised."""
        self.clock = RealClock() if rospy.rostime.is_wallclock() else SimulatedClock()
        self._lock = threading.Lock()
        self.suspensions = Suspensions()
        self._motion_clock = MotionClock(self.clock.read()[1])

    @contextmanager
    def hold(self) -> Iterator[Instant]:
        """Hold the lock and yield the Instant, read under the lock, so that all are in order."""
        with self._lock:
            stamp, reading_ns = self.clock.read()
            yield Instant(stamp, reading_ns, self._motion_clock.update(reading_ns))
