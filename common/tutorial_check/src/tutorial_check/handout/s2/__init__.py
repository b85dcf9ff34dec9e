"""Section 2: packages."""
