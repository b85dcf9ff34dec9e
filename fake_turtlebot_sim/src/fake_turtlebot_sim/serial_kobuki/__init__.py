"""A Kobuki on a pseudo terminal: the firmware's side of the serial protocol, for its drivers."""
