"""Section 3: talker and listener."""
