#!/usr/bin/python3
"""Nodes are suspended, or killed and restarted: while LB is held only a release lets it drive.

A program that goes on sending is obeyed again.
"""

import itertools
import os
import threading
import time
from functools import partial

import rospy
from geometry_msgs.msg import Twist, Vector3

from tutorial_testing.nodes import pid_of
from tutorial_testing.rig import BASE, DRIVER, MUX, TIMEOUT_S, Rig, go_on, stop
from tutorial_testing.robot import PERIOD_S
from tutorial_testing.rostests import RosTest, run
from tutorial_testing.waiting import wait_for

DURATIONS_S = (0.2, 0.5, 1.0, 3.0)
FEW_S = (0.5, 3.0)  # of two nodes, and without a mux; the hunt draws others
# What a busy machine may add between a node and the next one, and to the stamps of this process.
BUSY_S = 0.3
ANEW_S = 0.3  # in which a program is obeyed again
WATCHED_S = 1.2  # after a node is back
BUSY_LOOP = ("/usr/bin/python3", "-c", "while True: pass")


class LostNodes(RosTest):
    def odometry_after(self, rig, back):
        """Return the odometry since a node is back [s], for WATCHED_S."""
        wait_for(lambda: rig.since(back + WATCHED_S), "odometry")
        return rig.since(back)

    def check_suspension(self, rig, pids, duration_s):
        """The robot comes to rest in time, and stays."""
        what = f"{' and '.join(pids)} for {duration_s} s"
        rig.drive()
        began = stop(pids.values())
        threading.Event().wait(duration_s)
        ended = go_on(pids.values())
        self.odometry_after(rig, ended)
        rest = began + TIMEOUT_S + PERIOD_S + BUSY_S
        if BASE in pids:
            rest = max(rest, ended + BUSY_S)
        moving = [moment.stamp - began for moment in rig.since(rest) if moment.moves]
        self.assertEqual(moving, [], what)
        stood = itertools.dropwhile(lambda moment: moment.moves, rig.since(began))
        again = [moment.stamp - began for moment in stood if moment.moves]
        self.assertEqual(again, [], f"{what}: moved again")

    def check_suspensions(self, with_mux, cases):
        """cases: (how many nodes at once, how long [s])."""
        with Rig(with_mux) as rig:
            pids = {node: pid_of(node) for node in rig.nodes}
            for size, duration_s in cases:
                for nodes in itertools.combinations(rig.nodes, size):
                    self.check_suspension(rig, {node: pids[node] for node in nodes}, duration_s)
            # No node was restarted, and all of them still do their work.
            rig.drive()
            self.assertEqual(pids, {node: pid_of(node) for node in rig.nodes})

    def test_every_node_and_every_pair_is_suspended(self):
        alone = [(1, duration_s) for duration_s in DURATIONS_S]
        self.check_suspensions(True, alone + [(2, duration_s) for duration_s in FEW_S])

    def test_every_node_without_a_mux_is_suspended(self):
        self.check_suspensions(False, [(1, duration_s) for duration_s in FEW_S])

    def check_restarts(self, with_mux, nodes):
        """The robot stands after each restart, although LB is held, until all is released."""
        with Rig(with_mux) as rig:
            for node in nodes:
                rig.drive()
                rig.kill(node)
                rig.start(node)
                pid_of(node)
                rig.wait_for_rest()
                began = rig.now.stamp
                moved = [m.stamp - began for m in self.odometry_after(rig, began) if m.moves]
                self.assertEqual(moved, [], node)
            rig.drive()

    def test_a_mux_or_robot_that_is_restarted_waits_for_the_release(self):
        self.check_restarts(True, (MUX, BASE))

    def test_joy2twist_or_a_robot_without_a_mux_that_is_restarted_waits_for_the_release(self):
        self.check_restarts(False, (DRIVER, BASE))

    def test_a_suspended_base_obeys_no_stale_command(self):
        with Rig(with_mux=False) as rig:
            rig.drive()
            base, driver = pid_of(BASE), pid_of(DRIVER)
            stop([base])
            threading.Event().wait(1.0)
            rig.kill(DRIVER, pid=driver)
            threading.Event().wait(1.0)
            ended = go_on([base])
            # The first odometry may still be of the time before.
            moved = [m.stamp - ended for m in self.odometry_after(rig, ended) if m.moves]
            self.assertEqual([late_s for late_s in moved if late_s > 0.1], [])

    def driven_anew(self, rig, ended):
        """Return the odometry since the robot drives again, after it stood since a time [s]."""
        moved = itertools.dropwhile(lambda moment: moment.moves, rig.since(ended))
        return list(itertools.dropwhile(lambda moment: not moment.moves, moved))

    def test_a_wanderer_that_never_sends_zero_drives_on_after_a_stall_on_a_busy_machine(self):
        """At 10 Hz, both processors busy, the base stopped for 1.5 s: within 0.3 s of a command."""
        for _ in range(os.cpu_count()):
            self.start(*BUSY_LOOP)
        with Rig(with_mux=False) as rig:
            rig.kill(DRIVER)
            cmd_vel, sent = self.publisher("cmd_vel", Twist, queue_size=1), []

            def wander(_):
                cmd_vel.publish(Twist(linear=Vector3(x=0.2)))
                sent.append(time.time())

            timer = rospy.Timer(rospy.Duration(0.1), wander)
            self.addCleanup(timer.shutdown)
            delays_s = []
            for _ in range(6):  # one of them: this process, too, waits for a processor
                wait_for(lambda: rig.odometry and rig.now.moves, "robot that drives")
                base = [pid_of(BASE)]
                stop(base)
                threading.Event().wait(1.5)
                ended = go_on(base)
                wait_for(partial(self.driven_anew, rig, ended), "robot that stood and drives on")
                command_s = next(at_s for at_s in sent if at_s > ended)
                delays_s.append(self.driven_anew(rig, ended)[0].stamp - command_s)
                if delays_s[-1] < ANEW_S:
                    return
            self.fail(f"it drove on {delays_s} s after a command")


if __name__ == "__main__":
    run()
