"""The udev rule for a Kobuki's USB cable."""

NAME = "57-kobuki.rules"  # kobuki_ftdi's name, so that one file replaces the other
FOLDER = "/etc/udev/rules.d"
GROUP = "dialout"
# How long FTDI's converter waits for more bytes: 16 ms by default, which delays each packet of the
# robot, and 1 ms at least.
LATENCY_MS = 1
RULES = f"""\
# The USB cable of a Kobuki, the base of a TurtleBot 2: /dev/kobuki, for the group {GROUP}.
# Made by: rosrun kobuki_node create_udev_rules
SUBSYSTEM=="tty", ATTRS{{idVendor}}=="0403", ATTRS{{idProduct}}=="6001", \\
  ATTRS{{serial}}=="kobuki*", GROUP="{GROUP}", MODE="0660", SYMLINK+="kobuki"
ACTION=="add", SUBSYSTEM=="usb-serial", DRIVER=="ftdi_sio", ATTRS{{serial}}=="kobuki*", \\
  ATTR{{latency_timer}}="{LATENCY_MS}"
"""
