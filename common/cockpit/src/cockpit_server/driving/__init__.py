"""Who drives a robot, with what, and why it stands."""
