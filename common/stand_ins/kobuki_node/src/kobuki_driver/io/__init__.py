"""The serial port, and what this computer knows of its ports."""
