"""Repeats what it receives on the topic chatter."""

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main() -> None:
    """Hand every message on chatter to callback() until the node is stopped."""
    rclpy.init()
    node = rclpy.create_node("listener")

    def callback(message: String) -> None:
        node.get_logger().info(f"{node.get_name()}: I heard {message.data}")

    node.create_subscription(String, "chatter", callback, 10)
    try:
        rclpy.spin(node)  # calls callback() itself, one message at a time
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # stopped


if __name__ == "__main__":
    main()
