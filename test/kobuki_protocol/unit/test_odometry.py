"""The pose from encoders and gyro, despite faults of the robot, the cable or the driver."""

from math import cos, degrees, pi, sin

import pytest

from kobuki_protocol.feedback import Core, Inertia
from kobuki_protocol.odometry import RAD_PER_TICK, Odometry, signed
from tutorial_testing.claims import claim

pytestmark = claim(
    "A Kobuki that was restarted, unplugged or driven by a suspended driver keeps its pose"
)
TICKS_PER_M = 11724.4  # 11.7244 ticks/mm (kobuki_driver's appendix)


class Robot:
    """A Kobuki that drives v [m/s], w [rad/s], and sends packets."""

    def __init__(self, odometry, started_s=10.0):
        self.odometry, self.now, self.started_s = odometry, started_s, started_s
        self.left = self.right = self.heading = 0.0
        self.first = Core(time_stamp=0), 0

    def packet(self):
        stamp = round(1000 * (self.now - self.started_s)) % 65536
        left, right = (int(way * TICKS_PER_M // 1) % 65536 for way in (self.left, self.right))
        return Core(stamp, left_encoder=left, right_encoder=right), Inertia.of(self.heading, self.w)

    def move(self, v, w, seconds):
        self.left += (v - 0.115 * w) * seconds
        self.right += (v + 0.115 * w) * seconds
        self.heading = (self.heading + w * seconds + pi) % (2 * pi) - pi
        self.now += seconds
        self.v, self.w = v, w

    def drive(self, v, w, seconds, late_s=0.0):
        for _ in range(round(seconds / 0.02)):
            self.move(v, w, 0.02)
            self.odometry.update(*self.packet(), self.now + late_s)

    def switch_off_and_on(self, seconds):
        self.now += seconds
        self.started_s = self.now
        self.left = self.right = self.heading = 0.0


@pytest.fixture
def robot():
    made = Robot(Odometry())
    made.drive(0.0, 0.0, 0.1)
    return made


def pose(robot):
    return robot.odometry.state.x, robot.odometry.state.y, robot.odometry.state.yaw


def test_a_metre_ahead(robot):
    robot.drive(0.5, 0.0, 2.0)
    assert pose(robot) == pytest.approx((1.0, 0.0, 0.0), abs=2e-4)
    state = robot.odometry.state
    assert (state.v, state.w) == pytest.approx((0.5, 0.0), abs=5e-3)
    assert state.left_angle == pytest.approx(1.0 / 0.035, rel=1e-3)
    assert state.left_rate == pytest.approx(0.5 / 0.035, rel=0.02)


def test_ten_metres_are_more_than_16_bits_of_ticks(robot):
    robot.drive(0.7, 0.0, 100 / 7)
    assert pose(robot) == pytest.approx((10.0, 0.0, 0.0), abs=1e-2)
    robot.drive(-0.7, 0.0, 100 / 7)
    assert pose(robot) == pytest.approx((0.0, 0.0, 0.0), abs=1e-2)


def test_a_minute_of_circles_is_exact_to_a_millimetre(robot):
    robot.drive(0.3, 0.7, 60.0)
    yaw = 42.0 - 14 * pi
    x, y = 0.3 / 0.7 * sin(yaw), 0.3 / 0.7 * (1 - cos(yaw))
    assert pose(robot)[:2] == pytest.approx((x, y), abs=1e-3)
    assert degrees(pose(robot)[2] - yaw) == pytest.approx(0.0, abs=0.1)


def test_the_heading_is_that_of_the_gyro_not_of_the_wheels(robot):
    core, _ = robot.packet()
    robot.odometry.update(core, Inertia.of(1.0, 0.25), robot.now)
    assert robot.odometry.state.yaw == pytest.approx(1.0, abs=1e-4)
    robot.now += 0.02
    core, _ = robot.packet()
    robot.odometry.update(core, Inertia.of(1.0, 0.25), robot.now)
    assert robot.odometry.state.w == pytest.approx(0.25, abs=1e-4)


def test_without_the_gyro_the_wheels_turn_it():
    robot = Robot(Odometry(uses_gyro=False))
    robot.drive(0.0, 0.0, 0.1)
    robot.drive(0.0, 1.0, 1.0)
    robot.heading = 0.0
    robot.drive(0.0, 0.0, 0.1)
    assert pose(robot) == pytest.approx((0.0, 0.0, 1.0), abs=2e-3)
    assert robot.odometry.gyro_heading == pytest.approx(0.0, abs=1e-3)


def test_a_driver_that_starts_later_begins_at_zero():
    robot = Robot(Odometry())
    robot.move(0.5, 1.0, 3.0)
    robot.odometry.update(*robot.packet(), robot.now)
    assert pose(robot) == (0.0, 0.0, 0.0)
    robot.drive(0.5, 0.0, 1.0)
    assert pose(robot) == pytest.approx((0.5, 0.0, 0.0), abs=1e-3)


@pytest.mark.parametrize("off_s", [0.005, 1.0, 3.7, 70.0, 3600.0])
def test_a_robot_that_was_switched_off_and_on_keeps_its_pose(robot, off_s):
    robot.drive(0.5, 0.5, 3.0)
    before = pose(robot)
    robot.switch_off_and_on(off_s)
    robot.drive(0.0, 0.0, 0.2)
    assert pose(robot) == pytest.approx(before, abs=1e-6)
    robot.drive(0.5, 0.0, 1.0)
    x, y, yaw = before
    moved = (x + 0.5 * cos(yaw), y + 0.5 * sin(yaw), yaw)
    assert pose(robot) == pytest.approx(moved, abs=1e-3)
    assert robot.odometry.counts == 2


@pytest.mark.parametrize("out_s", [0.3, 5.0, 65.6, 300.0])
def test_a_cable_that_was_out_costs_nothing_of_the_pose(robot, out_s):
    robot.drive(0.2, 0.0, 1.0)
    robot.move(0.2, 0.0, 0.5)  # it rolls on until its own timeout
    robot.move(0.0, 0.1, min(out_s, 3.0))  # someone turns it by hand
    robot.move(0.0, 0.0, max(0.0, out_s - 3.0))
    robot.drive(0.0, 0.0, 0.1)
    x, _, yaw = pose(robot)
    assert yaw == pytest.approx(0.1 * min(out_s, 3.0), abs=1e-3)
    assert x == pytest.approx(0.3, abs=0.01)
    assert robot.odometry.counts == 1


def test_a_driver_that_was_suspended_catches_up(robot):
    robot.drive(0.5, 0.0, 1.0)
    robot.drive(0.5, 0.0, 0.8, late_s=10.0)  # what its port kept
    robot.move(0.0, 0.0, 9.2)  # what was lost
    robot.drive(0.5, 0.0, 1.0)
    assert pose(robot)[0] == pytest.approx(1.4, abs=1e-3)
    assert robot.odometry.counts == 1


def test_a_packet_that_came_late_is_known_by_the_clock_of_the_robot(robot):
    robot.drive(0.0, 0.0, 1.0)
    assert robot.odometry.late_s < 0.002
    robot.drive(0.0, 0.0, 0.02, late_s=0.3)
    assert robot.odometry.late_s == pytest.approx(0.3, abs=0.002)
    robot.drive(0.0, 0.0, 0.02)
    assert robot.odometry.late_s < 0.002
    robot.switch_off_and_on(2.0)  # the delay is then unknown
    robot.drive(0.0, 0.0, 0.02)
    assert robot.odometry.late_s == 0.0


def test_lost_packets_lose_no_travel(robot):
    for _ in range(20):
        robot.move(0.6, 0.0, 0.2)
        robot.drive(0.6, 0.0, 0.02)
    assert pose(robot)[0] == pytest.approx(0.6 * 4.4, abs=1e-3)


def test_a_reset_zeroes_pose_heading_and_wheels(robot):
    robot.drive(0.5, 1.0, 2.0)
    robot.odometry.reset()
    assert pose(robot) == (0.0, 0.0, 0.0)
    assert robot.odometry.state.left_angle == robot.odometry.gyro_heading == 0.0
    robot.drive(0.5, 0.0, 1.0)
    assert pose(robot) == pytest.approx((0.5, 0.0, 0.0), abs=1e-3)


def test_a_heading_that_passes_half_a_turn_does_not_jump(robot):
    robot.drive(0.0, 1.0, 2 * pi + 0.5)
    assert pose(robot) == pytest.approx((0.0, 0.0, 0.5), abs=0.03)


def test_the_clock_of_a_robot_may_be_wrong(robot):
    """Off by 500 ppm for ten minutes, 0.3 s; a gap is then not taken for a restart."""
    for _ in range(600):
        robot.drive(0.0, 0.0, 0.98)
        robot.now += 0.0005
        robot.started_s += 0.0005
    robot.move(0.1, 0.0, 1.0)
    robot.drive(0.0, 0.0, 0.04)
    assert robot.odometry.counts == 1
    assert pose(robot)[0] == pytest.approx(0.1, abs=1e-3)


def test_a_turn_of_a_wheel_is_2578_ticks():
    assert 2 * pi / RAD_PER_TICK == pytest.approx(2578.33, abs=0.01)
    assert [signed(10 - 65530), signed(65530 - 10), signed(7)] == [16, -16, 7]
