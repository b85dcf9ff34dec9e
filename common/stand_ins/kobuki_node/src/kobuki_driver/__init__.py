"""A driver of a Kobuki, the base of a TurtleBot 2, in place of kobuki_node's in C++."""
