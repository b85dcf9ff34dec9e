"""A robot in a world: sensors, edges, other robots, and places where it can be put."""

import cmath
from math import asin, cos, hypot, inf, nan, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fake_turtlebot_sim.simulator.contact import gap
from fake_turtlebot_sim.simulator.differential_drive import composed
from fake_turtlebot_sim.simulator.laser import Laser
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters, parse_parameters
from fake_turtlebot_sim.simulator.robot_messages import between_frames
from fake_turtlebot_sim.simulator.sensors import bumpers
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot, meet
from fake_turtlebot_sim.simulator.world import Surroundings, World, gaps
from fake_turtlebot_sim.simulator.world_messages import world_map
from tutorial_testing.claims import claim

pytestmark = claim(
    "At a wall the wheels stall; bumpers, cliffs and dropped wheels are where the Kobuki's are; "
    "robots stop each other"
)
R = 0.178
EXACT = 1e-9
PERIOD_NS = 20_000_000
NOBODY = np.empty((0, 5))
SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0), (-2.0, -2.0))
WALL = World((((1.0, -5.0), (1.0, 5.0)),))  # x = 1
EDGE = World(cliffs=(((1.0, -0.5), (3.0, -0.5), (3.0, 0.5), (1.0, 0.5)),))


def drive(robot, velocity, seconds, begin=0.0):
    """Command a velocity in every period, and yield the robot after each."""
    for cycle in range(round(begin * 50), round((begin + seconds) * 50)):
        robot.command(velocity, cycle * PERIOD_NS)
        robot.advance((cycle + 1) * PERIOD_NS)
        yield robot


def driven(robot, velocity, seconds, begin=0.0):
    *_, last = drive(robot, velocity, seconds, begin)
    return last


def test_at_a_wall_the_wheels_stall_and_odometry_says_so():
    robot = driven(SimulatedRobot(SimulatorParameters(world=WALL)), (0.5, 0.0), 4)
    state = robot.state()
    assert (state.x, state.v, state.left_rate) == (pytest.approx(1 - R, abs=EXACT), 0.0, 0.0)
    robot.advance(4 * 10**9)  # the same instant again
    assert robot.contact == pytest.approx(0.0, abs=EXACT)
    assert robot.sensed().bumpers == (False, True, False)
    assert state.left_angle == pytest.approx((1 - R) / 0.035)  # wheel radius: 35 mm
    assert driven(robot, (-0.5, 0.0), 0.5, 4).state().x == pytest.approx(1 - R - 0.25, abs=EXACT)
    assert robot.contact is None and not any(map(any, robot.sensed()))
    on_a_plane = SimulatedRobot(SimulatorParameters())
    assert not any(map(any, on_a_plane.sensed())) and not on_a_plane.odometry_differs
    robot = SimulatedRobot(
        SimulatorParameters(world=WALL, max_angular_acceleration=1.0), (1 - R, 0.0, 0.0)
    )
    robot.command((0.5, 0.5), 0)
    robot.advance(500_000_000)
    assert robot.state()[:3] == pytest.approx((1 - R, 0.0, 0.125)) == robot.true_pose


@pytest.mark.parametrize(
    ("speed", "ramp", "then"),
    [(0.7, 0.0, 0.7), (0.7, 0.01, 0.7), (0.7, 0.3, 0.7), (100.0, 0.0, 0.0), (12.0, 12.0, 0.0)],
)
def test_one_long_step_ends_at_the_wall_as_many_short_ones(speed, ramp, then):
    limits = {"max_linear_acceleration": ramp, "max_linear_speed": 0}  # 0: none
    world = World((((10.0, -5.0), (10.0, 5.0)),))
    robot = SimulatedRobot(SimulatorParameters(world=world, cmd_vel_timeout=60.0, **limits))
    driven(robot, (speed, 0.0), 1)
    robot.command((then, 0.0), 10**9)
    robot.advance(50 * 10**9)
    assert (robot.state().x, robot.true_pose[0]) == pytest.approx((10 - R, 10 - R), abs=EXACT)
    assert robot.state()[5:7] == pytest.approx(((10 - R) / 0.035, (10 - R) / 0.035))


def test_a_robot_with_errors_touches_with_its_true_body():
    parameters = SimulatorParameters(world=WALL, wheel_radius_ratio=1.02, wheel_noise=0.01)
    for robot in drive(SimulatedRobot(parameters), (0.5, 0.0), 4):
        assert robot.true_pose[0] <= 1 - R + EXACT
    assert robot.true_pose[0] == pytest.approx(1 - R, abs=EXACT)
    assert robot.state().v == 0.0
    assert sin(robot.contact) != 0.0  # only its heading is off


@pytest.mark.parametrize(("degrees", "pressed"), [
    (90, "L"), (45, "L"), (31, "L"), (30, "C"), (0, "C"), (-30, "C"), (-31, "R"), (-90, "R"),
    (91, ""), (-120, ""), (180, ""),
])  # fmt: skip
def test_the_bumpers_have_the_sectors_of_the_kobuki(degrees, pressed):
    felt = bumpers(degrees * pi / 180)
    assert "".join(name for name, is_on in zip("LCR", felt) if is_on) == pressed


@pytest.mark.parametrize("limits", [{}, {"max_linear_acceleration": 0.3}])
def test_both_wheels_drop_exactly_at_the_edge(limits):
    robot = driven(SimulatedRobot(SimulatorParameters(world=EDGE, **limits)), (0.7, 0.0), 5)
    assert robot.sensed().wheels == (True, True)
    assert robot.true_pose[0] == pytest.approx(1.0, abs=EXACT)
    assert robot.state()[3:5] == (0.0, 0.0)  # it stays there
    assert driven(robot, (-0.5, 0.0), 1, 5).true_pose[0] == pytest.approx(1.0, abs=EXACT)


def test_on_an_arc_the_outer_wheel_drops_first():
    """The right wheel drives a circle of 0.615 m around (0, 0.5)."""
    edge = World(cliffs=(((0.5, -3.0), (3.0, -3.0), (3.0, 3.0), (0.5, 3.0)),))
    robot = driven(SimulatedRobot(SimulatorParameters(world=edge)), (0.25, 0.5), 4)
    assert robot.sensed().wheels == (False, True)
    assert robot.true_pose[2] == pytest.approx(asin(0.5 / 0.615), abs=EXACT)
    robot.place((0.0, 0.0, 0.0))
    assert robot.sensed().wheels == (False, False)


def test_the_cliff_sensors_are_ahead_of_the_wheels():
    """The middle sensor detects the edge 0.156 m before the wheels reach it."""
    seen = {}
    for robot in drive(SimulatedRobot(SimulatorParameters(world=EDGE)), (0.1, 0.0), 12):
        for name, is_over in zip(("left", "center", "right"), robot.sensed().cliffs):
            if is_over:
                seen.setdefault(name, robot.true_pose[0])
    within = 0.1 * 0.02 + EXACT  # the distance in one period
    assert seen["center"] == pytest.approx(1 - 0.156, abs=within)
    assert seen["left"] == pytest.approx(1 - 0.08734, abs=within)
    assert seen["right"] == pytest.approx(1 - 0.085, abs=within)


def test_robots_stop_each_other():
    parameters = SimulatorParameters(world=World())
    one = SimulatedRobot(parameters, (0.0, 0.0, 0.0))
    other = SimulatedRobot(parameters, (2.0, 0.1, pi))
    far = SimulatedRobot(parameters, (9.0, 0.0, 0.0))
    for cycle in range(250):
        meet([one, other, far], parameters.meeting_reach())
        assert (one.company, other.company, far.company) == ([other], [one], [])
        for robot in (one, other):
            robot.command((0.3, 0.0), cycle * PERIOD_NS)
            robot.advance((cycle + 1) * PERIOD_NS)
        apart = hypot(*(a - b for a, b in zip(one.true_pose[:2], other.true_pose[:2])))
        assert apart > 2 * R - EXACT
    assert apart == pytest.approx(2 * R, abs=EXACT)
    assert one.sensed().bumpers == other.sensed().bumpers == (False, True, False)


def test_a_reset_of_the_odometry_leaves_the_robot_where_it_is():
    robot = SimulatedRobot(SimulatorParameters(world=World((SQUARE,))), (0.5, 0.5, 1.0))
    at = driven(robot, (0.2, 0.3), 2).true_pose
    robot.reset_odometry()
    assert (robot.true_pose, robot.state()[:3]) == (at, (0.0, 0.0, 0.0))
    odometry_in_map = between_frames(at, robot.state()[:3])
    driven(robot, (0.2, -0.3), 2, 2)
    assert composed(odometry_in_map, robot.state()[:3]) == pytest.approx(robot.true_pose, abs=EXACT)
    robot.reset()
    assert robot.true_pose == robot.state()[:3] == (0.5, 0.5, 1.0)


def test_it_is_not_put_into_a_wall_or_over_an_edge():
    robot = SimulatedRobot(SimulatorParameters(world=World((SQUARE,), cliffs=EDGE.cliffs)))
    for pose in ((1.9, 0.0, 0.0), (0.0, -1.9, 0.0), (0.9, 0.0, 0.0), (1.5, 0.0, 0.0)):
        with pytest.raises(ValueError, match=r"inside a wall|over an edge"):
            robot.place(pose)
    for far in (1e308, -1e7, inf):
        with pytest.raises(ValueError, match="a pose is at most 1e\\+06 m from"):
            robot.place((0.0, far, 0.0))
    assert robot.true_pose == (0.0, 0.0, 0.0)
    robot.place((0.0, 0.0, 1e7))  # an angle has no limit


@pytest.mark.parametrize(("given", "near", "far"), [("inf", -inf, inf), ("nan", nan, nan)])
def test_ranges_begin_at_the_camera_and_end_as_rep_117_or_a_depth_camera_has_it(given, near, far):
    laser = Laser(parse_parameters({"scan_no_return": given, "scan_beams": 3}), World((SQUARE,)))
    ahead, aside = 2.087, 2.087 / cos(29 * pi / 180)
    assert laser.measure((0.0, 0.0, 0.0), NOBODY)[:2] == pytest.approx([aside, ahead], abs=EXACT)
    ahead_of_a_wall = laser.measure((1.8, 0.0, 0.0), NOBODY)[1]  # 0.287 m
    robot = np.array([[0.5, 0.0125, 0.5, 0.0125, 0.2]])
    assert laser.measure((-1.5, 0.0, 0.0), robot)[1] == pytest.approx(ahead - 0.2, abs=EXACT)
    empty = Laser(parse_parameters({"scan_no_return": given, "scan_beams": 1}), World())
    nothing = empty.measure((0.0, 0.0, 0.0), NOBODY)
    assert [ahead_of_a_wall, *nothing] == pytest.approx([near, far], nan_ok=True)


def test_noise_is_drawn_from_the_seed_and_the_name():
    parameters = SimulatorParameters(world=World((SQUARE,)), scan_noise=0.02, scan_beams=1000)
    scans = [
        Laser(parameters, parameters.world, name).measure((0.0, 0.0, 0.0), NOBODY)
        for name in ("ada", "ada", "bob")
    ]
    exact = Laser(SimulatorParameters(scan_beams=1000), parameters.world).measure(
        (0.0, 0.0, 0.0), NOBODY
    )
    assert scans[0] == scans[1] != scans[2]
    assert np.std(np.subtract(scans[0], exact)) == pytest.approx(0.02, rel=0.15)


def test_a_map_has_its_walls_posts_and_edges():
    world = World((SQUARE,), ((0.0, 0.0, 0.3),), (((1.0, 1.0), (1.5, 1.0), (1.5, 1.5)),))
    grid = world_map(world, "map", None, 0.1)
    info, corner = grid.info, grid.info.origin.position

    def at(px, py):
        return grid.data[int((py - corner.y) / 0.1) * info.width + int((px - corner.x) / 0.1)]

    assert (corner.x, corner.y, info.height, info.width) == (-2.5, -2.5, 50, 50)
    assert [at(*place) for place in ((2.0, 0.3), (-1.7, 2.0), (0.2, 0.1), (1.3, 1.0))] == [100] * 4
    assert [at(*place) for place in ((1.8, 0.0), (0.5, 0.0), (-2.3, -2.3))] == [0] * 3


# Neighbours of a place in the order in which they are tried, as (ahead, left).
NEAR = [(0, -1), (-1, 0), (0, 1), (1, 0)]


@pytest.mark.parametrize("side", range(4))
def test_places_are_around_the_start_and_not_behind_a_wall(side):
    """A robot touches the wall at 0.422 m; the opposite one at 0.522 m, beyond the place."""
    start, turn = (1.0, 2.0, pi / 6), cmath.rect(1.0, pi / 6)

    def at(ahead, left):
        place = complex(1.0, 2.0) + turn * complex(ahead, left)
        return place.real, place.imag

    def wall(away, ahead, left):
        return tuple(at(away * ahead + k * left, away * left + k * ahead) for k in (-0.2, 0.2))

    ahead, left = NEAR[side]
    world = World((wall(0.6, ahead, left), wall(0.7, -ahead, -left)), start=start)
    free = [(0, 0), *(place for place in NEAR if place != (ahead, left))]
    further = [(0, -2), (-1, -1), (1, -1), (-2, 0)]
    for poses, ways in ((world.places(4), free), (World(start=start).places(9)[5:], further)):
        expected = [(*at(0.5 * ahead, 0.5 * left), pi / 6) for ahead, left in ways]
        assert np.array(poses) == pytest.approx(np.array(expected))
    corridor = World(tuple(((-2.0, y), (2.0, y)) for y in (-0.2, 0.2)))  # barely wider than a robot
    assert [x for x, *_ in corridor.places(3)] == [0.0, -0.5, 0.5]


whole = st.integers(-6, 6).map(float)
points = st.tuples(whole, whole)


@given(st.lists(st.tuples(points, points), min_size=1, max_size=9), st.lists(points, min_size=1))
def test_what_is_near_is_what_has_a_small_gap(walls, ways):
    around = Surroundings(World(walls=tuple(walls), posts=((1.0, 2.0, 0.3),)))
    for x, y in ways:
        each = [gap(x, y, 0.0, one) for one in around.world.obstacles]
        assert gaps(x, y, around.world.array) == pytest.approx(each, abs=EXACT)
        for reach in (0.4, 2.5):
            near = around.near(x, y, reach)
            far = [gap(x, y, 0.0, one) for one in near if gap(x, y, 0.0, one) > reach]
            assert all(one in near for one, m in zip(around.world.obstacles, each) if m <= reach)
            assert max(far, default=0.0) <= 2 * max(reach, 2.5)
