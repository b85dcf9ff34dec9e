"""Says hello ten times a second on the topic chatter."""

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main() -> None:
    """Publish until the node is stopped."""
    rclpy.init()
    node = rclpy.create_node("talker")
    publisher = node.create_publisher(String, "chatter", 10)

    def talk() -> None:
        text = f"hello world {node.get_clock().now().nanoseconds / 1e9:.2f}"
        node.get_logger().info(text)
        publisher.publish(String(data=text))

    node.create_timer(0.1, talk)  # [s]; in place of a loop with a Rate
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass  # stopped


if __name__ == "__main__":
    main()
