"""Turtles that drive and draw: turtlesim, in Python and with exact arcs."""
