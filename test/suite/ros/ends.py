"""Every node exits in time whatever the screen, peers and master do; a base comes to rest first."""

import contextlib
import math
import os
import signal
import termios

import pytest
import rosgraph
from geometry_msgs.msg import Twist, Vector3

from node_kit.ros.graph.ros_api import call
from tutorial_testing.claims import claim
from tutorial_testing.hands import DRIVE, RELEASED
from tutorial_testing.nodes import pid_of
from tutorial_testing.processes import suspended
from tutorial_testing.rig import BASE, Rig
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import BUSY_S, wait_for

LONGEST_END_S = 1.5 + BUSY_S


@claim("(a) to (i), as the table of FAULTS.md has them", because="end to end, at the end")
@pytest.mark.long
class FaultsAtTheEnd(RosTest):
    def check_each(self, rig, number, meanwhile):
        """Check that each node exits in time within meanwhile(node), and that the robot rests."""
        for node in rig.nodes:
            rig.drive()
            pid = pid_of(node)
            with meanwhile(node):
                self.assertLess(rig.kill(node, number, pid), LONGEST_END_S, node)
            wait_for(lambda: not rig.moves, "robot at rest after an end")
            if node != BASE:
                rig.start(node)

    def test_each_exits_on_ctrl_c_while_the_screen_is_held(self):
        keyboard, screen = os.openpty()
        self.addCleanup(os.close, keyboard)
        termios.tcflow(screen, termios.TCOOFF)  # as Ctrl-S does
        with Rig(screen=os.ttyname(screen)) as rig:
            self.check_each(rig, signal.SIGINT, lambda _: contextlib.nullcontext())

    def test_each_exits_on_sigterm_while_its_peers_and_the_master_are_suspended(self):
        with Rig() as rig:
            pids = lambda node: master() + [pid_of(n) for n in rig.nodes if n != node]  # noqa: E731
            self.check_each(rig, signal.SIGTERM, lambda node: suspended(pids(node)))

    def test_a_warning_while_the_master_hangs_makes_no_node_deaf(self):
        """NaN and a speed beyond the robot's make the mux and the base log a warning."""
        with Rig() as rig:
            rig.drive()
            pilot = self.connected("/cmd_vel_mux/input/teleop", Twist)
            with suspended(master()):
                for bad in (math.nan, 5.0, math.nan):
                    pilot.publish(Twist(linear=Vector3(x=bad)))
                rig.hands.show(RELEASED)
                rig.wait_for_rest(rig.now.stamp)
                rig.hands.show(DRIVE)
                wait_for(lambda: rig.moves, "robot that obeys")


def master():
    return [call(rosgraph.get_master_uri(), "getPid")[1]]
