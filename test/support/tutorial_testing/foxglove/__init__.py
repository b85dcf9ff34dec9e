"""The reference clients of npm for a foxglove_bridge."""
