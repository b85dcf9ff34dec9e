"""The node, and the choice between a robot and its simulation."""
