"""Step 3: the same as a class, which leaves the robot standing when it is stopped."""

import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import Joy


class NewJoy2Twist(Node):  # noqa: D101  see above
    def __init__(self) -> None:
        super().__init__("NewJoy2Twist")
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 1)
        self.joy = self.create_subscription(Joy, "joy", self.callback, 10)

    def callback(self, joy: Joy) -> None:
        twist = Twist()
        if len(joy.axes) >= 2:
            twist.linear.x, twist.angular.z = joy.axes[1], joy.axes[0]
        self.cmd_vel.publish(twist)
        self.get_logger().info(f"Get from Joy {[round(value, 2) for value in joy.axes]}")

    def shutdown(self) -> None:
        for _ in range(3):  # no callback comes between: nothing spins any more
            self.cmd_vel.publish(Twist())
            time.sleep(0.1)


def main() -> None:
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)  # its own end ROS too early
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = NewJoy2Twist()
    try:
        while True:
            rclpy.spin_once(node, timeout_sec=0.1)  # returns now and then, to notice Ctrl-C
    except KeyboardInterrupt:
        node.shutdown()


if __name__ == "__main__":
    main()
