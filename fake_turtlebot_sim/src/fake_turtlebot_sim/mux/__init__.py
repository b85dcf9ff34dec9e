"""The rules of the velocity multiplexer, cmd_vel_mux."""
