"""Section 6.2: a class."""
