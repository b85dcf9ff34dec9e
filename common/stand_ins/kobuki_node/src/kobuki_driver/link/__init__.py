"""What is to be said of the line to the robot (pure)."""
