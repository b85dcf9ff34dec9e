"""virtual_joystick: a Logitech F710 moved by keys, a script or a recording."""
