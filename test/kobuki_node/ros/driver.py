"""The driver and a Kobuki on a serial line: what it publishes, and how it handles faults."""

import math
import os
import signal
import time

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import (
    BumperEvent,
    ControllerInfo,
    DockInfraRed,
    Led,
    MotorPower,
    RobotStateEvent,
    SensorState,
    VersionInfo,
)
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Empty, Int16MultiArray, String
from tf2_msgs.msg import TFMessage

from kobuki_protocol import commands
from kobuki_protocol.identity import FirmwareVersion
from tutorial_testing.claims import claim
from tutorial_testing.kobuki_on_a_line import KobukiOnALine
from tutorial_testing.nodes import node_path, pid_of
from tutorial_testing.processes import suspended
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import Stopwatch, tolerance, wait_for

BASE = "/mobile_base"
TOPICS = {
    "odom": Odometry, "joint_states": JointState, "/tf": TFMessage, "sensors/core": SensorState,
    "sensors/imu_data": Imu, "events/bumper": BumperEvent, "events/robot_state": RobotStateEvent,
    "version_info": VersionInfo, "controller_info": ControllerInfo,
    "sensors/imu_data_raw": Imu, "sensors/dock_ir": DockInfraRed, "debug/raw_data_stream": String,
    "debug/raw_data_command": String, "debug/raw_control_command": Int16MultiArray,
    "/diagnostics": DiagnosticArray,
}  # fmt: skip
AHEAD, ZERO = (0.3, 0.5), (0.0, 0.0)
TIMEOUT_S = 0.6


@claim(
    "The driver publishes what a Kobuki reports, and commands it once for each packet; after a "
    "loss, a suspension, a restart or a mistake the robot stands until the next command; its pose "
    "does not jump"
)
class DriverTest(RosTest):
    def setUp(self):
        self.link = str(self.folder() / "kobuki")
        self.robot = self.enter(KobukiOnALine(self.link))
        self.programs = []
        self.got = {
            topic: self.record(topic if topic.startswith("/") else f"{BASE}/{topic}", kind)
            for topic, kind in TOPICS.items()
        }
        self.velocities = self.publisher(f"{BASE}/commands/velocity", Twist, queue_size=1)

    def begin(self, *more, name="mobile_base"):
        command = [node_path("kobuki_node", "kobuki_node"), f"__name:={name}", *more]
        self.programs.append(self.start(*command, f"_device_port:={self.link}"))
        wait_for(lambda: pid_of(f"/{name}") == self.programs[-1].pid, "driver", seen=self.said)

    def plugged(self):
        self.robot.plug()
        self.begin()
        wait_for(lambda: self.got["odom"] and self.got["version_info"], "odometry", seen=self.said)

    def said(self):
        return "".join(program.output for program in self.programs)

    def send(self, velocity):
        v, w = velocity
        self.velocities.publish(Twist(Vector3(v, 0.0, 0.0), Vector3(0.0, 0.0, w)))

    def drive(self, velocity=AHEAD):
        def moves():
            self.send(velocity)
            return self.robot.moves and self.state() == RobotStateEvent.ONLINE

        wait_for(moves, "motion", seen=self.said)

    def state(self):
        states = self.got["events/robot_state"]
        return states[-1].state if states else None

    def rests(self):
        wait_for(lambda: not self.robot.moves, "rest", seen=self.said)

    def test_it_publishes_what_the_robot_reports(self):
        self.plugged()
        self.drive()
        wait_for(lambda: len(self.got["sensors/core"]) > 50, "packets")
        self.rests()
        odometry, joints = self.got["odom"][-1], self.got["joint_states"][-1]
        self.assertEqual(odometry.header.frame_id, "odom")
        self.assertEqual(odometry.child_frame_id, "base_footprint")
        self.assertEqual(odometry.pose.covariance[::7], (0.1, 0.1, 1e10, 1e10, 1e10, 0.05))
        self.assertEqual(joints.name, ["wheel_left_joint", "wheel_right_joint"])
        self.assertEqual(joints.effort, (0.0, 0.0))
        turned = 2 * math.atan2(odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w)
        self.assertAlmostEqual(turned, self.robot.heading, delta=0.01)
        way = joints.position[0] * 0.035 * 11724.4
        self.assertAlmostEqual(way, self.robot.ticks[0], delta=20)
        (transform,) = self.got["/tf"][-1].transforms
        self.assertEqual(transform.child_frame_id, "base_footprint")
        self.assertEqual(self.got["sensors/imu_data"][-1].header.frame_id, "gyro_link")
        version = self.got["version_info"][-1]
        self.assertEqual((version.firmware, version.udid), ("1.2.0", (1, 2, 3)))
        self.assertEqual(self.got["controller_info"][-1], ControllerInfo(0, 100.0, 0.1, 2.0))
        wait_for(lambda: self.got["/diagnostics"], "diagnostics")
        self.assertEqual([topic for topic, came in self.got.items() if not came], ["events/bumper"])
        earlier, later = self.got["sensors/imu_data_raw"][-2:]
        self.assertAlmostEqual(later.angular_velocity.z, math.radians(200 * 0.00875))
        between = later.header.stamp - earlier.header.stamp
        self.assertEqual(between.to_nsec(), 10_000_000)
        zero = "[ 0xaa 0x55 0x06 0x01 0x04 0x00 0x00 0x00 0x00 0x03 ]"
        self.assertIn(zero, [one.data for one in self.got["debug/raw_data_command"]])
        self.assertTrue(self.got["debug/raw_data_stream"][-1].data.startswith("{ AA 55 "))
        controls = [one.data for one in self.got["debug/raw_control_command"]]
        self.assertIn((357, 600, 300, 500), controls)
        self.robot.core = {"bumper": 4}
        pressed = BumperEvent(BumperEvent.LEFT, BumperEvent.PRESSED)
        wait_for(lambda: pressed in self.got["events/bumper"], "bumper")
        stamps = [one.header.stamp.to_sec() for one in self.got["odom"]]
        self.assertEqual(stamps, sorted(set(stamps)))

    def test_a_command_expires_and_each_packet_is_answered(self):
        self.plugged()
        self.drive()
        extra, sent_s = tolerance(), time.monotonic()
        self.rests()
        self.assertLess(time.monotonic() - sent_s, TIMEOUT_S + 0.1 + extra())
        self.assertIn("no velocity came for 0.60 s", wait_for(self.said, "line"))
        begin = len(self.robot.controls)
        packets = len(self.got["odom"])
        wait_for(lambda: len(self.got["odom"]) - packets >= 50, "packets")
        self.assertAlmostEqual(len(self.robot.controls) - begin, 50, delta=5)
        self.drive()  # the next command drives

    def test_what_is_no_velocity_is_ignored(self):
        self.plugged()
        self.drive()
        for velocity in ((math.nan, 0.0), (0.1, math.inf)):
            self.send(velocity)
        self.rests()
        wait_for(lambda: "not a finite number; ignored" in self.said(), "line", seen=self.said)
        self.drive()

    @claim(
        "Each fault of the port or the line is one line that says what to do, and the driver waits"
    )
    def test_without_a_port_it_waits_and_a_robot_that_is_plugged_in_stands(self):
        self.begin()
        wait_for(lambda: f"there is no {self.link}" in self.said(), "line", seen=self.said)
        self.send(AHEAD)
        self.robot.plug()
        wait_for(lambda: self.state() == RobotStateEvent.ONLINE, "robot", seen=self.said)
        wait_for(lambda: len(self.robot.controls) > 25, "commands")
        self.assertEqual([one for _, one in self.robot.controls if one.speed], [])
        self.drive()
        self.assertEqual(self.said().count("there is no"), 1)

    def test_a_cable_that_was_out_changes_nothing_but_the_motion(self):
        self.plugged()
        self.drive()
        self.robot.unplug()
        wait_for(lambda: self.state() == RobotStateEvent.OFFLINE, "loss", seen=self.said)
        self.send(AHEAD)
        self.robot.velocity = ZERO  # by its own timeout
        begin = len(self.robot.controls)
        self.robot.plug()
        wait_for(lambda: self.state() == RobotStateEvent.ONLINE, "robot", seen=self.said)
        wait_for(lambda: len(self.robot.controls) > begin + 25, "commands")
        self.assertEqual([one for _, one in self.robot.controls[begin:] if one.speed], [])
        self.drive()
        self.check_pose()

    def check_pose(self):
        """Check that the pose is still that of the wheels, once they are at rest."""
        self.rests()
        count = len(self.got["odom"])
        wait_for(lambda: len(self.got["odom"]) > count + 5, "packets")
        turned = self.got["odom"][-1].pose.pose.orientation
        yaw = 2 * math.atan2(turned.z, turned.w)
        self.assertAlmostEqual(yaw, self.robot.heading, delta=0.02)

    def test_a_robot_that_is_restarted_keeps_its_pose_and_stands(self):
        self.plugged()
        self.drive()
        self.robot.is_on = False
        wait_for(lambda: self.state() == RobotStateEvent.OFFLINE, "loss", seen=self.said)
        wait_for(lambda: "sends nothing any more" in self.said(), "line", seen=self.said)
        before = self.got["odom"][-1].pose.pose
        begin = len(self.robot.controls)
        self.robot.restart()
        self.robot.is_on = True
        wait_for(lambda: self.state() == RobotStateEvent.ONLINE, "robot", seen=self.said)
        wait_for(lambda: len(self.robot.controls) > begin + 25, "commands")
        self.assertEqual([one for _, one in self.robot.controls[begin:] if one.speed], [])
        after = self.got["odom"][-1].pose.pose
        self.assertAlmostEqual(before.position.x, after.position.x, delta=0.01)
        self.assertAlmostEqual(before.orientation.z, after.orientation.z, delta=0.02)
        self.drive()

    def test_garbage_costs_only_itself(self):
        self.robot.noise = bytes.fromhex("00 aa 55 10 01 0f ff aa")
        self.plugged()
        self.drive()
        wait_for(lambda: "were damaged; the others are used" in self.said(), "line", seen=self.said)
        self.assertEqual(self.said().count("were damaged"), 1)

    @claim("Another major version of the firmware is not driven")
    def test_another_firmware_is_not_driven(self):
        self.robot.firmware = FirmwareVersion(0, 0, 2)
        self.plugged()
        wait_for(lambda: "firmware 2.0.0: this driver supports only 1.x" in self.said(), "line")
        for _ in range(20):
            self.send(AHEAD)
            time.sleep(0.02)
        self.assertEqual([one for _, one in self.robot.controls if one.speed], [])

    def test_ctrl_c_and_a_newer_node_leave_a_standing_robot(self):
        self.plugged()
        for end in (self.press_ctrl_c, self.start_a_newer_one):
            self.drive()
            end()
            self.rests()
        self.assertNotIn("Traceback", self.said())

    def press_ctrl_c(self):
        os.kill(pid_of(BASE), signal.SIGINT)
        watch = Stopwatch()
        self.programs[-1].wait()
        self.assertLess(watch.took_s, 3.0)
        self.rests()
        self.begin()

    def start_a_newer_one(self):
        old = self.programs[-1]
        self.begin("_take_over:=true")
        old.wait()

    def test_a_suspended_driver_does_not_obey_what_came_meanwhile(self):
        self.plugged()
        self.drive()
        with suspended([pid_of(BASE)]):
            self.robot.velocity = ZERO  # by its own timeout
            for _ in range(60):
                self.send(AHEAD)
                time.sleep(0.02)
            begin = len(self.robot.controls)
        wait_for(lambda: len(self.robot.controls) > begin + 25, "commands", seen=self.said)
        late = [at for at, one in self.robot.controls[begin:] if one.speed]
        self.assertEqual(late, [])
        self.drive()

    def test_motors_leds_and_resets_are_obeyed(self):
        self.plugged()
        kinds = {"motor_power": MotorPower, "led1": Led, "reset_odometry": Empty}
        topics = {
            name: self.connected(f"{BASE}/commands/{name}", kind) for name, kind in kinds.items()
        }
        topics["led1"].publish(Led(Led.GREEN))
        green = commands.Outputs(0x02F0)
        wait_for(lambda: green in [one for _, one in self.robot.received], "LED", seen=self.said)
        self.drive()
        topics["motor_power"].publish(MotorPower(MotorPower.OFF))
        self.rests()
        self.send(AHEAD)
        wait_for(lambda: "the motors are off, by commands/motor_power; vel" in self.said(), "line")
        self.assertFalse(self.robot.moves)
        topics["motor_power"].publish(MotorPower(MotorPower.ON))
        self.drive()
        self.rests()
        wait_for(lambda: self.got["odom"][-1].twist.twist.linear.x == 0.0, "rest in the odometry")
        topics["reset_odometry"].publish(Empty())
        wait_for(lambda: self.got["odom"][-1].pose.pose.position.x == 0.0, "reset")

    def test_two_drivers_never_share_a_port(self):
        self.plugged()
        self.begin(name="second")
        wait_for(lambda: "two drivers would command" in self.said(), "line", seen=self.said)
        self.drive()
