"""A picture of a recorded joystick."""
