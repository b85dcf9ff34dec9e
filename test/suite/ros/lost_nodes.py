"""Nodes are suspended, or killed and restarted: with LB held, the robot waits for its release.

A program that goes on sending is obeyed again.
"""

import itertools
import signal
import threading

import pytest
import rospy
from geometry_msgs.msg import Twist, Vector3

from tutorial_testing.claims import claim
from tutorial_testing.nodes import pid_of
from tutorial_testing.processes import signal_all, suspend
from tutorial_testing.rig import BASE, DRIVER, MUX, TIMEOUT_S, Rig
from tutorial_testing.robot import PERIOD_S
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import tolerance, wait_for

WATCHED_S = 1.2  # after a node is back


@claim("(a) to (i), as the table of FAULTS.md has them", because="end to end, of lost nodes")
@pytest.mark.long
class LostNodes(RosTest):
    def check_rest(self, rig, began_s, ended_s, what, rests_s=0.0):
        """Check that nothing moves for WATCHED_S after rests_s, or again after it has rested."""
        wait_for(lambda: rig.since(ended_s + WATCHED_S), "odometry")
        resting = itertools.dropwhile(lambda moment: moment.moves, rig.since(began_s))
        moved = [moment for moment in resting if moment.moves]
        moved += [moment for moment in rig.since(rests_s or ended_s) if moment.moves]
        self.assertEqual([moment.stamp - began_s for moment in moved], [], what)

    def check_suspension(self, rig, node, duration_s):
        """Check that the robot comes to rest in time, and stays at rest."""
        pids = [pid_of(node)]
        rig.drive()
        late_s, began_s = tolerance(), suspend(pids)
        threading.Event().wait(duration_s)
        ended_s = signal_all(pids, signal.SIGCONT)
        wait_for(lambda: rig.since(ended_s + WATCHED_S), "odometry")
        rests_s = began_s + TIMEOUT_S + PERIOD_S + late_s()
        if node == BASE:
            rests_s = max(rests_s, ended_s + late_s())
        self.check_rest(rig, began_s, ended_s, f"{node} for {duration_s} s", rests_s)

    def check_restart(self, rig, node):
        """Check that the robot stays at rest, although LB is held."""
        rig.drive()
        rig.kill(node)
        rig.start(node)
        pid_of(node)
        rig.wait_for_rest()
        self.check_rest(rig, rig.now.stamp, rig.now.stamp, node)

    def test_only_a_release_lets_a_robot_that_lost_a_node_drive_on(self):
        for with_mux, restarted in ((True, (MUX, BASE)), (False, (DRIVER, BASE))):
            with Rig(with_mux) as rig:
                for node, duration_s in itertools.product(rig.nodes, (0.5, 3.0)):
                    self.check_suspension(rig, node, duration_s)
                for node in restarted:
                    self.check_restart(rig, node)
                rig.drive()

    def test_a_program_that_never_sends_zero_drives_on_after_the_base_was_suspended(self):
        with Rig(with_mux=False) as rig:
            rig.kill(DRIVER)
            cmd_vel = self.publisher("cmd_vel", Twist, queue_size=1)
            command = Twist(linear=Vector3(x=0.2))
            timer = rospy.Timer(rospy.Duration(0.1), lambda _: cmd_vel.publish(command))
            self.addCleanup(timer.shutdown)
            wait_for(lambda: rig.moves, "robot that drives")
            base = [pid_of(BASE)]
            suspend(base)
            stopped = rig.now.stamp
            threading.Event().wait(1.5)
            signal_all(base, signal.SIGCONT)
            later = stopped + 1.5 + 2 * TIMEOUT_S  # when earlier commands have expired
            moves = lambda: any(moment.moves for moment in rig.since(later))  # noqa: E731
            wait_for(moves, "robot that drives on")
