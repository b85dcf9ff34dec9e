"""Step 2: turn every joy message into a velocity, published from the callback.

Axis 1 (stick forward) drives linear.x [m/s], axis 0 (stick left) drives angular.z [rad/s].
"""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import Joy


def main() -> None:
    """Hand every joy message to callback() until the node is stopped."""
    rclpy.init()
    node = rclpy.create_node("converter")
    publisher = node.create_publisher(Twist, "cmd_vel", 1)

    def callback(joy: Joy) -> None:
        """Publish the velocity first, because displaying takes longer; then display the axes."""
        twist = Twist()  # all zero, and so it stays when the joystick has too few axes
        if len(joy.axes) >= 2:
            twist.linear.x = joy.axes[1]
            twist.angular.z = joy.axes[0]
        publisher.publish(twist)

        axes = ", ".join(f"{value:.2f}" for value in joy.axes)
        node.get_logger().info(f"{node.get_name()}: Get from Joy [{axes}]")

    node.create_subscription(Joy, "joy", callback, 10)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # stopped


if __name__ == "__main__":
    main()
