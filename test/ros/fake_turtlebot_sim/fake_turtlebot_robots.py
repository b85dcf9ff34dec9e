#!/usr/bin/python3
"""Many robots in one node: each is, to the last bit, what it would be alone."""

import random

import rospy
from fake_turtlebot_stepping import CommandedRobot, World

from fake_turtlebot_sim.simulator.parameters import parse_parameters
from fake_turtlebot_sim.simulator.simulated_robot import SimulatedRobot
from tutorial_testing.rostests import RosTest, run


class RobotsTest(RosTest):
    @classmethod
    def setUpClass(cls):
        cls.parameters = parse_parameters(rospy.get_param("/classroom"))
        cls.names = list(cls.parameters.robots)
        cls.robots = {name: CommandedRobot(f"{name}/").__enter__() for name in cls.names}
        cls.world = World(list(cls.robots.values()))

    def test_each_robot_is_bitwise_what_it_would_be_alone(self):
        rng, log = random.Random(3), []
        for k in range(40):
            name = self.names[k % len(self.names)]
            velocity = (rng.uniform(-0.7, 0.7), rng.uniform(-3, 3))
            arrived_ns = self.world.command(self.robots[name], *velocity)
            log.append((arrived_ns, name, velocity))
        self.world.step()  # in which the last one shows, if it came as a step ended
        begin_ns = log[0][0]
        for name in self.names:
            told = self.robots[name].since(rospy.Time(0, begin_ns).to_sec())
            alone = SimulatedRobot(self.parameters, self.parameters.robots[name], name)
            commands = [(at, velocity) for at, who, velocity in log if who == name]
            for moment in told:
                now_ns = round(moment.stamp * 1e9)
                while commands and commands[0][0] < now_ns:
                    at, velocity = commands.pop(0)
                    alone.command(velocity, at - begin_ns)
                alone.advance(now_ns - begin_ns)
                state = alone.state()
                self.assertEqual((moment.x, moment.y), (state.x, state.y))
            self.assertEqual(commands, [])
            self.assertNotEqual((state.x, state.y), self.parameters.robots[name][:2])


if __name__ == "__main__":
    run()
