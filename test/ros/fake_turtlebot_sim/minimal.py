"""The whole of minimal.launch, seen from outside as a TurtleBot 2 is."""

import rosgraph
import rospy
from geometry_msgs.msg import Twist, Vector3
from kobuki_msgs.msg import ButtonEvent, MotorPower, SensorState
from sensor_msgs.msg import Imu

from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

BASE, MUX = "/mobile_base", "/cmd_vel_mux"
KOBUKI = {  # below /mobile_base: the type in kobuki_msgs
    "events/bumper": "BumperEvent", "events/button": "ButtonEvent", "events/cliff": "CliffEvent",
    "events/digital_input": "DigitalInputEvent", "events/power_system": "PowerSystemEvent",
    "events/robot_state": "RobotStateEvent", "events/wheel_drop": "WheelDropEvent",
    "sensors/core": "SensorState", "sensors/dock_ir": "DockInfraRed",
    "version_info": "VersionInfo", "commands/controller_info": "ControllerInfo",
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


class MinimalTest(RosTest):
    def test_it_has_the_topics_of_a_turtlebot_2(self):
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
        # The base subscribes to the mux alone.
        self.assertNotIn("/cmd_vel", dict(master.getTopicTypes()))

    def test_the_base_has_encoders_imu_motors_and_buttons_of_a_kobuki(self):
        robot, core = self.enter(Robot()), self.record("mobile_base/sensors/core", SensorState)
        imu = self.record("mobile_base/sensors/imu_data", Imu)
        commands = self.record("mobile_base/commands/velocity", Twist)
        events = self.record("mobile_base/events/button", ButtonEvent)
        navi = self.publisher("cmd_vel_mux/input/navi", Twist)
        motors = self.publisher("mobile_base/commands/motor_power", MotorPower)
        press = self.publisher("mobile_base/press", ButtonEvent)
        for publisher in (navi, motors, press):
            wait_for(publisher.get_num_connections, f"subscriber of {publisher.name}")
        wait_for(lambda: robot.odometry and core and imu, "first messages")

        first = core[-1]

        def way():
            return (core[-1].right_encoder - first.right_encoder) % 65536

        wait_for(lambda: navi.publish(TURN) or way() > 2000, "encoders that count")
        self.assertEqual(commands[-1], TURN)  # all six numbers
        last = imu[-1]
        self.assertEqual((last.header.frame_id, last.angular_velocity.z), ("gyro_link", 0.5))

        motors.publish(MotorPower.OFF)
        wait_for(lambda: navi.publish(TURN) or not robot.now.moves, "motors that are off")
        motors.publish(MotorPower.ON)
        wait_for(lambda: navi.publish(TURN) or robot.now.moves, "motors that are on")

        for state in (ButtonEvent.PRESSED, ButtonEvent.RELEASED):
            press.publish(button=ButtonEvent.Button1, state=state)
            shown = SensorState.BUTTON1 if state == ButtonEvent.PRESSED else 0
            wait_for(lambda shown=shown: core[-1].buttons == shown, "button")
        self.assertEqual([event.state for event in events], [1, 0])
