"""The rules of the robot: velocities, identification, diagnostics."""
