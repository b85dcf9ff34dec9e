"""Sections 4.2, 4.4 and 4.5: recording, robot, joystick."""
