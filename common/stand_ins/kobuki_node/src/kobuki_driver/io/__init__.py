"""The serial port, and this computer's information about its ports."""
