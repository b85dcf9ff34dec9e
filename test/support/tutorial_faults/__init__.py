"""What must never happen to a robot, as invariants; and the searches for a way to break them."""
