"""What cannot happen to a robot, as invariants; and what looks for a way to break them."""
