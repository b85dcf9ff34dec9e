"""Section 5: launch files."""
