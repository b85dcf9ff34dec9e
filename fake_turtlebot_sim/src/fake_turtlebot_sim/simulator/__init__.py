"""The rules of the simulated TurtleBot."""
