"""The rules of the serial link to the robot."""
