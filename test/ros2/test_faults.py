"""Random faults of the bridge while ROS 2 drives the robot: ./tutorial test faults --bridge.

The class in ROS 2 is the handout's and obeys any Joy. So what is judged is the bridge's: the wheels
rest in time when a part of the way is lost (d), nothing that waited anywhere moves them later (f),
and the robot is driven again once all is back (h).
"""

import random
import signal
import time

from drive import CLASS, REST_S, Stick, moves

from tutorial_testing.processes import signal_all
from tutorial_testing.waiting import wait_for

OLD_S = 0.5  # how old the list lets a Joy be, and a velocity
PROGRAM = "program"
SIGNALS = {"kill": signal.SIGKILL, "end": signal.SIGTERM, "stop": signal.SIGSTOP}
# SIGTERM to the side of ROS 1, as by rosnode kill, ends the whole bridge.
FAULTS = {"ROS 1": ["kill", "stop"], "ROS 2": sorted(SIGNALS), PROGRAM: sorted(SIGNALS)}


class Way:
    """The bridge, the program in ROS 2, and what can be done to each."""

    def __init__(self, bridge, start_ros2):
        self.bridge, self._start = bridge, lambda: start_ros2(CLASS)
        self.program = self._start()

    def drives(self, robot):
        """Whether the robot does; the program is started again if it has ended."""
        if self.program.ended:
            self.program = self._start()
        return self.bridge.is_up() and moves(robot)

    def send(self, part, number):
        pid = self.program.pid if part == PROGRAM else self.bridge.process(part)
        signal_all([pid] if pid else [], number)

    def hit(self, kind, part, lasts_s):
        """Return whether a part was lost for long enough to be seen."""
        self.send(part, SIGNALS[kind])
        if kind == "stop":
            time.sleep(lasts_s)
            self.send(part, signal.SIGCONT)
        return kind != "stop" or lasts_s >= REST_S


def trial(seed, way, robot):
    """A drive with one or two faults, then a release. Raises AssertionError with the seed."""
    draw = random.Random(seed)
    parts = draw.sample(sorted(FAULTS), k=draw.choice((1, 2)))
    faults = [(draw.choice(FAULTS[part]), part) for part in parts]
    del robot.heard[:-1]
    stick, lost = Stick().begin(), []
    try:
        wait_for(lambda: way.drives(robot), "a robot that drives")
        for kind, part in faults:
            time.sleep(draw.uniform(0.0, 0.4))
            began_s = time.monotonic()
            if way.hit(kind, part, draw.uniform(0.02, 2 * REST_S)):
                lost.append(began_s)
        time.sleep(draw.uniform(0.0, 2.0))
    finally:
        rests_s = stick.end() + REST_S + OLD_S
    # A second in which what waited somewhere would move it.
    wait_for(lambda: robot.heard[-1][0] > rests_s + 1.0, "odometry")
    turned = [(when, abs(one.twist.twist.linear.x) > 0.01) for when, _, one in list(robot.heard)]
    for began_s in lost:
        after = [moved for when, moved in turned if began_s < when <= began_s + REST_S]
        assert not all(after), f"{faults}: (d) it drove on"
    late = [moved for when, moved in turned if when > rests_s]
    assert late and not any(late), f"{faults}: (f) it moved after the release"


def test_random_faults_of_the_bridge_leave_a_robot_that_rests_in_time(
    bridge, start_ros2, robot, request
):
    option, way = request.config.getoption, Way(bridge(), start_ros2)
    for seed in range(option("--seed"), option("--seed") + option("--trials")):
        try:
            trial(seed, way, robot)
        except AssertionError as error:
            output = f"{way.bridge.output}\n{way.program.output}"
            raise AssertionError(f"seed {seed}: {error}\n{output}") from None
    stick = Stick().begin()
    wait_for(lambda: way.drives(robot), "a robot that drives after all that")
    stick.end()
    assert "Traceback" not in way.bridge.output, way.bridge.output
