"""Starts the demonstration and counts what it sends."""
