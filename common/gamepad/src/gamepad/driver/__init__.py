"""joy_node: from a gamepad to sensor_msgs/Joy."""
