"""Joining the classroom of another machine."""
