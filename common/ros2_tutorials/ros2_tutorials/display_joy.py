"""Step 1: subscribe to joy and display the axes of every message."""

import rclpy
from rclpy.executors import ExternalShutdownException
from sensor_msgs.msg import Joy


def main() -> None:
    """Hand every joy message to callback() until the node is stopped."""
    rclpy.init()
    node = rclpy.create_node("listener")

    def callback(joy: Joy) -> None:
        """Display the name of the node and all axes, however many the joystick has."""
        axes = ", ".join(f"{value:.2f}" for value in joy.axes)
        node.get_logger().info(f"{node.get_name()}: Get from Joy [{axes}]")

    node.create_subscription(Joy, "joy", callback, 10)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # stopped


if __name__ == "__main__":
    main()
