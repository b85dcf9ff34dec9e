"""A stick held forward and a safety controller, in the room and on the table."""

import random
from math import hypot, remainder, tau

import pytest

from fake_turtlebot_sim.safety.reaction import Reaction
from fake_turtlebot_sim.simulator.parameters import SimulatorParameters
from fake_turtlebot_sim.simulator.sensors import Sensed
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from fake_turtlebot_sim.simulator.world_files import read_world, shipped_worlds
from kobuki_protocol.events import EVENTS
from tutorial_testing.claims import claim

pytestmark = claim("No stick held forward drives over an edge or pushes for long")
PERIOD_S = 0.02  # sensor period
DELAY, LONGEST_DELAY = 2, 5  # periods from an event to the command that answers it
LONGEST_PUSH_S = 0.5
ROOM, TABLE = (read_world(shipped_worlds()[name]) for name in ("room", "table"))


class Drive:
    """A robot, its safety controller, and a mux that lets the controller win for 0.2 s."""

    def __init__(self, world, delay=DELAY):
        self.robot = SimulatedRobot(SimulatorParameters(world=world), world.start)
        self.reaction = Reaction(0.0)
        self.sensed, self.cycle = Sensed(), 0
        self.answers, self.holds_until, self.pushed = [None] * delay, 0.0, 0
        self.longest_push = 0

    def step(self, stick):
        now = self.cycle * PERIOD_S
        answer = self.answers.pop(0)
        if answer is not None:
            self.holds_until = now + 0.2
            self.robot.command(answer, round(now * 1e9))
        elif now >= self.holds_until:
            self.robot.command(stick, round(now * 1e9))
        self.cycle += 1
        self.robot.advance(round(self.cycle * PERIOD_S * 1e9))
        before, self.sensed = self.sensed, self.robot.sensed()
        for (kind, _, _), was, is_now in zip(EVENTS, before, self.sensed):
            for sensor, (old, new) in enumerate(zip(was, is_now)):
                if old != new:
                    self.reaction.event(kind, sensor, new, now)
        self.answers.append(self.reaction.velocity(now))
        self.pushed = self.pushed + 1 if any(self.sensed.bumpers) else 0
        self.longest_push = max(self.longest_push, self.pushed)


def test_random_sticks_never_push_into_a_wall_for_long():
    drive, draw, way = Drive(ROOM), random.Random(1), 0.0
    while drive.cycle < 150.0 / PERIOD_S:
        stick = draw.uniform(-0.3, 0.7), draw.uniform(-2.0, 2.0)
        for _ in range(round(draw.uniform(0.5, 3.0) / PERIOD_S)):
            last_x, last_y, _ = drive.robot.true_pose
            drive.step(stick)
            x, y, _ = drive.robot.true_pose
            way += hypot(x - last_x, y - last_y)
    assert drive.longest_push * PERIOD_S <= LONGEST_PUSH_S
    assert way > 10.0  # it is never caught
    state = drive.robot.state()  # what the wheels turned: none slipped
    assert state[:3] == pytest.approx(drive.robot.true_pose, abs=1e-6)
    turned = (state.right_angle - state.left_angle) * 0.035 / 0.23
    assert remainder(turned - state.yaw, tau) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_no_stick_held_forward_drives_over_the_edge(seed):
    """With any delay, and however often the stick is lost and returns.

    Only on arcs wider than the robot: a Kobuki has no sensors beside and behind its wheels.
    """
    draw = random.Random(seed)
    v, w = draw.choice((0.05, 0.7, draw.uniform(0.05, 0.7))), draw.uniform(-0.7, 0.7)
    yaw, delay = draw.uniform(-3.1, 3.1), draw.randint(1, LONGEST_DELAY)
    cuts = draw.choices(range(1000), k=draw.randint(0, 6))
    w = max(-v / 0.4, min(v / 0.4, w))
    drive = Drive(TABLE, delay=delay)
    drive.robot.place((0.0, 0.0, yaw))
    for cycle in range(1000):
        is_cut = sum(cut <= cycle for cut in cuts) % 2
        drive.step((0.0, 0.0) if is_cut else (v, w))
        assert drive.robot.sensed().wheels == (False, False)
    assert drive.longest_push * PERIOD_S <= LONGEST_PUSH_S
