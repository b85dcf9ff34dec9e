"""A driver for a Kobuki, the base of a TurtleBot 2, which replaces kobuki_node's in C++."""
