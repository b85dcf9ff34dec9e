"""Faults of a Kobuki's driver, line and robot while LB is held: the wheels stop in time.

The wheels' true motion comes from serial_kobuki, not from the driver's odometry.
"""

import signal
import threading
import time

import pytest
import rosgraph

from node_kit.ros.graph.ros_api import call
from tutorial_testing.claims import claim
from tutorial_testing.hands import DRIVE, RELEASED
from tutorial_testing.nodes import pid_of
from tutorial_testing.processes import signal_all, suspend
from tutorial_testing.rig import REST_S, TIMEOUT_S
from tutorial_testing.robot import PERIOD_S
from tutorial_testing.rostests import RosTest
from tutorial_testing.serial_rig import BASE, SerialRig
from tutorial_testing.waiting import tolerance, wait_for

LASTS_S = 1.5  # duration of a fault: long enough for the wheels to stop
BAD_CABLE_S = 12.0  # includes a stall
LONGEST_REST_S = 0.6  # over a bad cable, on a machine that is not busy
WATCHED_S = 1.2  # after the fault


@claim(
    "Killed, ended or suspended, without its cable, robot or master: a Kobuki's driver leaves "
    "wheels that rest in time, and the robot is driven again after a release"
)
@pytest.mark.long
class LineFaults(RosTest):
    def check_rest(self, rig, begin, end):
        """Check that the wheels stop in time after begin(), which returns its time; then end()."""
        rig.drive()
        late_s = tolerance()
        began_s = begin()
        threading.Event().wait(LASTS_S)
        rests_s = began_s + TIMEOUT_S + PERIOD_S + late_s()
        wait_for(lambda: rig.since(rests_s), "truth")
        moved = [m.stamp - began_s for m in rig.since(began_s) if m.moves and m.stamp > rests_s]
        self.assertEqual(moved, [])
        end()

    def check_that_a_release_is_needed(self, rig):
        since = rig.now.stamp
        wait_for(lambda: rig.since(since + WATCHED_S), "truth")
        self.assertFalse([m.stamp for m in rig.since(since) if m.moves])

    def test_1_the_driver_is_killed_ended_or_suspended(self):
        with SerialRig() as rig:
            for number in (signal.SIGKILL, signal.SIGINT):

                def end(number=number):
                    now = time.time()
                    rig.kill(BASE, number)
                    return now

                def restart():
                    rig.start(BASE)
                    pid_of(BASE)

                self.check_rest(rig, end, restart)
                self.check_that_a_release_is_needed(rig)
            pids = [pid_of(BASE)]
            self.check_rest(rig, lambda: suspend(pids), lambda: signal_all(pids, signal.SIGCONT))
            self.check_that_a_release_is_needed(rig)
            rig.drive()

    def test_2_the_cable_is_out_the_robot_restarts_or_sends_garbage(self):
        with SerialRig() as rig:

            def asked(*what):
                now = time.time()
                rig.ask(*what)
                return now

            for begin, end in (
                (("plug_in", False), ("plug_in", True)),
                (("switch_on", False), ("switch_on", True)),
                (("send_garbage", True), ("send_garbage", False)),
            ):
                self.check_rest(rig, lambda begin=begin: asked(*begin), lambda end=end: asked(*end))
            rig.drive()
            asked("reboot")
            rig.wait_for_rest(time.time())
            rig.drive()

    def test_3_over_a_bad_cable_it_is_driven_on(self):
        with SerialRig("_drop:=0.05", "_corrupt:=0.05", "_stall:=0.1") as rig:
            rig.drive()
            late_s, since = tolerance(), rig.now.stamp
            wait_for(lambda: rig.since(since + BAD_CABLE_S), "truth")
            rests, began_s = [0.0], since
            for moment in rig.since(since):
                began_s = moment.stamp if moment.moves else began_s
                rests.append(moment.stamp - began_s)
            self.assertLess(max(rests), LONGEST_REST_S + late_s())
            wait_for(lambda: rig.now.moves, "a robot that moves")

    def test_4_firmware_of_another_major_version_is_not_driven(self):
        with SerialRig("_other_firmware:=2.0.0") as rig:
            wait_for(lambda: rig.odometry, "truth")
            wait_for(lambda: "2.0.0" in rig.programs[BASE].output, "line about the firmware")
            for _ in range(3):
                rig.hands.show(RELEASED)
                time.sleep(REST_S)
                rig.hands.show(DRIVE)
                time.sleep(REST_S)
            self.assertFalse([m for m in rig.odometry if m.moves])

    def test_5_a_master_that_hangs_changes_nothing_and_the_driver_ends_at_rest(self):
        uri = rosgraph.get_master_uri()
        master = call(uri, "getPid")[1]
        with SerialRig() as rig:
            base = pid_of(BASE)
            rig.drive()
            began_s = suspend([master])
            try:
                wait_for(lambda: rig.since(began_s + WATCHED_S), "truth")
                self.assertTrue(all(m.moves for m in rig.since(began_s)))  # it still drives
                late_s, ended_s = tolerance(), time.time()
                rig.kill(BASE, signal.SIGINT, base)
                wait_for(lambda: rig.since(ended_s + WATCHED_S), "truth")
                moved = [m.stamp - ended_s for m in rig.since(ended_s) if m.moves]
                self.assertLess(max(moved, default=0.0), TIMEOUT_S + PERIOD_S + late_s())
            finally:
                signal_all([master], signal.SIGCONT)
            rig.start(BASE)
            pid_of(BASE)
            rig.drive()
