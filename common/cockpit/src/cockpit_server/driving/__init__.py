"""Who drives a robot, by what, and why it stands."""
