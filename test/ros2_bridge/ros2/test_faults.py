"""Losses on the way through ROS 2: the robot rests in time, and can be driven again.

The class in ROS 2 is the handout's, which obeys any Joy. So these tests judge the bridge: wheels
rest in time when a part of the way is lost (d), no delayed message moves them later (f), and the
robot can be driven once all is back (h). ./tutorial test faults --bridge: at random.
"""

import random
import signal
import time

import pytest
import rospy
from drive import CLASS, RATE, REST_S, ZERO, Bridge, Stick, carried, wait_for_doctor
from geometry_msgs.msg import Twist

from node_kit import ros2_python
from tutorial_testing.claims import claim
from tutorial_testing.processes import signal_all
from tutorial_testing.robot import Robot
from tutorial_testing.waiting import HOP_S, tolerance, wait_for

OLD_S = 0.5  # the age limit of a Joy, and of a velocity, in our list of topics
PROGRAM = "program"
SIGNALS = {"kill": signal.SIGKILL, "end": signal.SIGTERM, "stop": signal.SIGSTOP}
# SIGTERM to the side of ROS 1, as by rosnode kill, ends the whole bridge.
FAULTS = {"ROS 1": ["kill", "stop"], "ROS 2": sorted(SIGNALS), PROGRAM: sorted(SIGNALS)}
SEEN_S, LONGEST_S = REST_S + HOP_S, 5.0  # the shortest loss that is noticed; the longest one


class Way:
    def __init__(self, start, robot):
        self.twists, self.robot = [], robot
        rospy.Subscriber("/cmd_vel", Twist, self.twists.append, tcp_nodelay=True)
        start("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py")
        self.bridge = Bridge(start("rosrun", "ros2_bridge", "bridge"))
        self._start = lambda: start(*ros2_python.command([str(CLASS)]))
        self.program = self._start()

    def drives(self):
        """Return whether the robot drives; restart the program if it has ended."""
        if self.program.ended:
            self.program = self._start()
        return self.bridge.is_up() and self.robot.moves

    def send(self, part, number):
        """Send a signal to a part; return the time [s] just before."""
        pid = self.program.pid if part == PROGRAM else self.bridge.process(part)
        return signal_all([pid] if pid else [], number)

    def hit(self, kind, part, lasts_s):
        """Lose a part; return whether the loss was long enough to be noticed."""
        self.send(part, SIGNALS[kind])
        if kind == "stop":
            time.sleep(lasts_s)
            self.send(part, signal.SIGCONT)
        if kind == "kill" and part != PROGRAM:
            line = f"bridge: the side of {part} has ended (signal 9): it is restarted"
            wait_for(lambda: line in self.bridge.program.output, "the line about it")
        return kind != "stop" or lasts_s >= SEEN_S


@pytest.fixture(scope="module")
def whole_way(start_for_all):
    with Robot() as robot:
        yield Way(start_for_all, robot)


@pytest.fixture
def way(whole_way, stick):
    stick.begin()
    wait_for(whole_way.drives, "a robot that drives")
    return whole_way


@claim("No velocity comes late: what waited for a suspended side moves nothing")
@pytest.mark.parametrize("side", ["ROS 1", "ROS 2"])
def test_what_waited_for_a_suspended_side_does_not_move_the_robot(way, stick, side, start):
    way.send(side, signal.SIGSTOP)
    sent = len(stick.sent)
    wait_for(lambda: len(stick.sent) > sent + 3 * RATE * OLD_S, "Joys that become too old")
    way.robot.wait_for_rest()
    stick.end()
    if side == "ROS 2":
        wait_for_doctor(start, "bridge the side of ROS 2 is missing: its terminal")
    before = len(carried(way.twists))
    way.send(side, signal.SIGCONT)

    def has_passed():
        stick.push(*ZERO)
        return ZERO in carried(way.twists)[before:]

    wait_for(has_passed, "a zero, which comes after all that waited")
    late = [pair for pair in carried(way.twists)[before:] if any(pair)]
    assert len(late) <= RATE * OLD_S  # those of the last half second, within the age limit
    way.robot.wait_for_rest()


@claim("`Ctrl-C` of the class in ROS 2 ends with zeros")
def test_ctrl_c_of_the_class_ends_with_zeros(way):
    way.program.interrupt()
    assert way.program.wait() == 0, way.program.output
    wait_for(lambda: carried(way.twists)[-1] == ZERO, "a zero")
    assert "Traceback" not in way.program.output


def trial(seed, way):
    """Drive with one or two faults, then release."""
    draw = random.Random(seed)
    parts = draw.sample(sorted(FAULTS), k=draw.choice((1, 2)))
    faults = [(draw.choice(FAULTS[part]), part) for part in parts]
    del way.robot.odometry[:-1]
    lost, late_s = [], tolerance()
    with Stick().begin() as stick:
        wait_for(way.drives, "a robot that drives")
        for kind, part in faults:
            time.sleep(draw.uniform(0.0, 0.4))
            began_s = time.time()
            if way.hit(kind, part, draw.uniform(0.02, LONGEST_S)):
                lost.append(began_s)
        time.sleep(draw.uniform(0.0, 2.0))
        ended_s = stick.end() + REST_S + OLD_S
    # In this second a delayed message would move the robot.
    wait_for(lambda: way.robot.now.stamp > ended_s + late_s() + 1.0, "odometry")
    for began_s in lost:
        until_s = began_s + REST_S + late_s()
        after = [moment.moves for moment in way.robot.since(began_s) if moment.stamp <= until_s]
        assert not all(after), f"{faults}: (d) it drove on"
    late = [moment.moves for moment in way.robot.since(ended_s + late_s())]
    assert late and not any(late), f"{faults}: (f) it moved after the release"


@claim(
    "(d), (f), (h) Faults of the bridge to ROS 2 leave a robot that rests in time and can be "
    "driven again; a side that is killed is restarted with a line"
)
def test_random_faults_of_the_bridge_leave_a_robot_that_rests_in_time(whole_way, request):
    option, way = request.config.getoption, whole_way
    for seed in range(option("--seed"), option("--seed") + option("--trials")):
        try:
            trial(seed, way)
        except AssertionError as error:
            output = f"{way.bridge.program.output}\n{way.program.output}"
            raise AssertionError(f"seed {seed}: {error}\n{output}") from None
    with Stick().begin():
        wait_for(way.drives, "a robot that drives after all that")
    assert "Traceback" not in way.bridge.program.output, way.bridge.program.output
