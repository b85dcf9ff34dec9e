"""What the driver knows of the robot and makes of commands (pure)."""
