"""What must never happen to a robot, as invariants, and the searches for violations."""
