"""The simulated TurtleBot."""
