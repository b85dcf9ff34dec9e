"""The pseudo terminal, the process beside it, and the loop that serves both."""
