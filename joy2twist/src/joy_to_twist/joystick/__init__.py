"""Joysticks: the driver joy_node and the virtual gamepad virtual_joystick."""
