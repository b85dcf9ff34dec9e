"""Backs a bumped robot off: the node safety_controller."""
