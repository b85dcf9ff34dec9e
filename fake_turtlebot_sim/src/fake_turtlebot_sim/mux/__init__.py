"""The multiplexer of velocities."""
