"""minimal.launch as a whole, seen from outside like a TurtleBot 2 in a room.

Topics, map, scan, bumpers and frames; the way back from a wall; the mux after a suspension.
"""

import functools
import operator
import time
from math import isfinite

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import BumperEvent, ButtonEvent, ControllerInfo, Led, MotorPower, SensorState
from nav_msgs.msg import OccupancyGrid, Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu, JointState, LaserScan
from std_msgs.msg import Int16MultiArray, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from tutorial_testing.claims import claim
from tutorial_testing.nodes import pid_of
from tutorial_testing.processes import suspended
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import Stopwatch, wait_for

BASE, MUX = "/mobile_base", "/cmd_vel_mux"
KOBUKI = {  # below /mobile_base, with the type in kobuki_msgs
    "events/bumper": "BumperEvent", "events/button": "ButtonEvent", "events/cliff": "CliffEvent",
    "events/digital_input": "DigitalInputEvent", "events/power_system": "PowerSystemEvent",
    "events/robot_state": "RobotStateEvent", "events/wheel_drop": "WheelDropEvent",
    "sensors/core": "SensorState", "sensors/dock_ir": "DockInfraRed",
    "version_info": "VersionInfo", "controller_info": "ControllerInfo",
    "commands/controller_info": "ControllerInfo",
    "commands/digital_output": "DigitalOutput", "commands/external_power": "ExternalPower",
    "commands/led1": "Led", "commands/led2": "Led", "commands/motor_power": "MotorPower",
    "commands/sound": "Sound",
}  # fmt: skip
# Topic: (type, node that publishes or subscribes to it).
TOPICS = {
    f"{MUX}/active": ("std_msgs/String", MUX),
    f"{BASE}/commands/reset_odometry": ("std_msgs/Empty", BASE),
    f"{BASE}/sensors/imu_data": ("sensor_msgs/Imu", BASE),
    f"{BASE}/sensors/imu_data_raw": ("sensor_msgs/Imu", BASE),
    f"{BASE}/debug/raw_data_command": ("std_msgs/String", BASE),
    f"{BASE}/debug/raw_data_stream": ("std_msgs/String", BASE),
    f"{BASE}/debug/raw_control_command": ("std_msgs/Int16MultiArray", BASE),
    "/odom": ("nav_msgs/Odometry", BASE),
    "/joint_states": ("sensor_msgs/JointState", BASE),
    "/tf": ("tf2_msgs/TFMessage", BASE),
    **{f"{BASE}/{name}": (f"kobuki_msgs/{kind}", BASE) for name, kind in KOBUKI.items()},
    **{
        f"{MUX}/input/{name}": ("geometry_msgs/Twist", MUX)
        for name in ("safety_controller", "teleop", "switch", "navi")
    },
}
TURN = Twist(Vector3(0.2, 0.01, 0.02), Vector3(0.03, 0.04, 0.5))
AT_THE_WALL = 4.0 - 0.178  # x of the robot's middle [m]
BEHIND_M = 0.087  # distance of the camera behind the robot's middle
LONGEST_PUSH_S = 0.5
OUTAGE_S = 1.0
BACKLOG = ([0.3] * 500 + [0.0] * 500) * 3 + [0.3] * 500  # [m/s], more than one read takes


def ahead(speed):
    return Twist(linear=Vector3(x=speed))


@claim("`minimal.launch` has the topics and types of a TurtleBot 2, its mux and its Kobuki")
class MinimalTest(RosTest):
    def test_1_map_markers_frames_and_scan_show_the_room(self):
        grids, scans = self.record("map", OccupancyGrid), self.record("scan", LaserScan)
        markers, frames = self.record("world_markers", MarkerArray), {}

        def on_tf(message):
            for link in message.transforms:
                x = round(link.transform.translation.x, 6)
                frames[link.header.frame_id, link.child_frame_id] = x

        for topic in ("/tf", "/tf_static"):
            self.hear(topic, TFMessage, on_tf)
        expected = {("map", "odom"): 0.0, ("base_footprint", "camera_depth_frame"): -BEHIND_M}
        wait_for(lambda: expected.items() <= frames.items(), "transforms")
        wait_for(lambda: grids and markers and scans, "first messages")
        self.assertEqual((grids[0].header.frame_id, set(grids[0].data)), ("map", {0, 100}))
        self.assertEqual({marker.ns for marker in markers[0].markers}, {"walls", "posts"})
        scan = scans[0]
        self.assertEqual((scan.header.frame_id, len(scan.ranges)), ("camera_depth_frame", 640))
        self.assertAlmostEqual(scan.ranges[320], 4.0 + BEHIND_M, delta=1e-3)  # the wall ahead

    @claim("A bumped robot backs off and turns away", because="end to end")
    def test_2_at_the_wall_it_backs_off_however_the_stick_is_held(self):
        events, unmeasured = [], set()  # (time, event); ranges that are not numbers
        truths = self.record("base_pose_ground_truth", Odometry)
        shown = self.record("bumper_markers", MarkerArray)
        self.hear(
            "mobile_base/events/bumper", BumperEvent,
            lambda event: events.append((time.monotonic(), event)),
        )  # fmt: skip
        self.hear(
            "scan", LaserScan,
            lambda scan: unmeasured.update(str(r) for r in scan.ranges if not isfinite(r)),
        )  # fmt: skip
        teleop = self.connected("cmd_vel_mux/input/teleop", Twist, queue_size=1)

        def drive(v, until, what):
            wait_for(lambda: teleop.publish(ahead(v)) or until(), what)

        watch = Stopwatch()
        drive(0.7, lambda: len(events) >= 8, "the wall, met four times")
        places = [truth.pose.pose.position.x for truth in truths]
        self.assertLessEqual(max(places), AT_THE_WALL + 1e-9)
        self.assertEqual([event.state for _, event in events[:8]], [1, 0] * 4)
        self.assertEqual({event.bumper for _, event in events}, {BumperEvent.CENTER})
        pushes = [off - on for (on, _), (off, _) in zip(events[::2], events[1::2])]
        self.assertLess(max(pushes), LONGEST_PUSH_S + watch.lost_s)
        self.assertTrue(shown)
        self.assertEqual(unmeasured, {"nan"})  # at the wall, like on a real TurtleBot
        drive(-0.5, lambda: truths[-1].pose.pose.position.x < 3.0, "way back, by the stick")

    def test_3_it_has_the_topics_of_a_turtlebot_2(self):
        master = rosgraph.Master(rospy.get_name())

        def missing():
            state, kinds = [*map(dict, master.getSystemState())], dict(master.getTopicTypes())
            return [
                topic
                for topic, (kind, node) in TOPICS.items()
                if kinds.get(topic) != kind
                or node not in state["/commands/" in topic or "/input/" in topic].get(topic, [])
            ]

        wait_for(lambda: not missing(), "topics of a TurtleBot 2")
        # The base subscribes only to the mux.
        self.assertNotIn("/cmd_vel", dict(master.getTopicTypes()))

    def test_4_the_base_has_encoders_imu_motors_and_buttons_of_a_kobuki(self):
        robot, core = self.enter(Robot()), self.record("mobile_base/sensors/core", SensorState)
        imu = self.record("mobile_base/sensors/imu_data", Imu)
        commands = self.record("mobile_base/commands/velocity", Twist)
        events = self.record("mobile_base/events/button", ButtonEvent)
        navi = self.connected("cmd_vel_mux/input/navi", Twist)
        motors = self.connected("mobile_base/commands/motor_power", MotorPower)
        press = self.connected("mobile_base/press", ButtonEvent)
        robot.wait_for_rest()  # after the previous test
        core.clear()
        wait_for(lambda: core and imu, "first messages")

        first = core[-1]

        def way():
            return (core[-1].right_encoder - first.right_encoder) % 65536

        wait_for(lambda: navi.publish(TURN) or way() > 2000, "encoders that count")
        self.assertEqual(commands[-1], TURN)  # all six numbers
        last = imu[-1]
        self.assertEqual((last.header.frame_id, last.angular_velocity.z), ("gyro_link", 0.5))

        log = self.record("/rosout", Log)
        motors.publish(7)
        wait_for(lambda: any("7 is neither 0" in line.msg for line in log), "error line")
        wait_for(lambda: navi.publish(TURN) or robot.now.moves, "motors that are still on")
        motors.publish(MotorPower.OFF)
        wait_for(lambda: navi.publish(TURN) or not robot.now.moves, "motors that are off")
        motors.publish(MotorPower.ON)
        wait_for(lambda: navi.publish(TURN) or robot.now.moves, "motors that are on")

        for state in (ButtonEvent.PRESSED, ButtonEvent.RELEASED):
            press.publish(button=ButtonEvent.Button1, state=state)
            shown = SensorState.BUTTON1 if state == ButtonEvent.PRESSED else 0
            wait_for(lambda shown=shown: core[-1].buttons == shown, "button")
        self.assertEqual([event.state for event in events], [1, 0])

    def test_5_imu_gains_and_the_bytes_of_the_serial_line_are_those_of_kobuki_node(self):
        raw = self.record("mobile_base/sensors/imu_data_raw", Imu)
        imu = self.record("mobile_base/sensors/imu_data", Imu)
        joints = self.record("joint_states", JointState)
        gains = self.record("mobile_base/controller_info", ControllerInfo)
        sent = self.record("mobile_base/debug/raw_data_command", String)
        received = self.record("mobile_base/debug/raw_data_stream", String)
        controls = self.record("mobile_base/debug/raw_control_command", Int16MultiArray)
        led = self.connected("mobile_base/commands/led1", Led)
        navi = self.connected("cmd_vel_mux/input/navi", Twist)
        wait_for(lambda: raw[10:] and imu and joints and gains and received, "first messages")
        both = imu[0].orientation_covariance[8], imu[0].angular_velocity_covariance[8]
        self.assertEqual(both, (0.05, 0.05))
        self.assertEqual(joints[0].effort, (0.0, 0.0))
        info = gains[0]
        self.assertEqual((info.type, info.p_gain, info.i_gain, info.d_gain), (0, 100.0, 0.1, 2.0))

        def pairs():
            stamps = [reading.header.stamp.to_nsec() for reading in list(raw)]
            return sum(b - a == 10_000_000 for a, b in zip(stamps, stamps[1:]))

        wait_for(lambda: pairs() >= 10, "pairs of readings, 10 ms apart")
        packet = bytes.fromhex(received[0].data[2:-2])  # { AA 55 .. }
        checksum = functools.reduce(operator.xor, packet[2:])
        self.assertEqual((packet[:3].hex(), len(packet), checksum), ("aa554d", 81, 0))
        led.publish(Led.GREEN)
        command = "[ 0xaa 0x55 0x04 0x0c 0x02 0xf0 0x02 0xf8 ]"  # supplies on, LED 1 green
        wait_for(lambda: command in [line.data for line in sent], "command for an LED")
        wait_for(
            lambda: navi.publish(TURN) or (controls and controls[-1].data == (257, 400, 200, 500)),
            "control command",
        )

    @claim("The highest input ...", because="a suspension")
    def test_6_late_commands_move_nothing_and_those_of_now_do(self):
        active, log = self.record("cmd_vel_mux/active", String), self.record("/rosout", Log)
        wait_for(lambda: active and active[-1].data == "idle", "a mux that is idle")
        driven = []  # [m/s]
        hear = lambda command: driven.append(command.linear.x)  # noqa: E731
        self.hear("mobile_base/commands/velocity", Twist, hear)
        teleop = self.connected("cmd_vel_mux/input/teleop", Twist, queue_size=len(BACKLOG))
        wait_for(lambda: teleop.publish(ahead(0.2)) or 0.2 in driven, "a command that goes through")
        with suspended([pid_of("/cmd_vel_mux")]):
            ends_s = time.monotonic() + OUTAGE_S
            for speed in BACKLOG:
                teleop.publish(ahead(speed))
            # All must be sent by now: what a busy machine sends later would not be late.
            waits = lambda: any(link._queue for link in teleop.impl.connections)  # noqa: E731
            wait_for(lambda: not waits(), "end of sending")
            wait_for(lambda: time.monotonic() > ends_s, "end of the outage")
        wait_for(lambda: any("suspended" in line.msg for line in log), "warning that it was")
        wait_for(lambda: teleop.publish(ahead(0.4)) or driven[-1] == 0.4, "a command of now")
        # On one connection, earlier messages arrive earlier.
        self.assertEqual(set(driven), {0.2, 0.0, 0.4})
