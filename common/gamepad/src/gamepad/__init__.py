"""Gamepads: the driver, the virtual gamepad, and what both know of them."""
