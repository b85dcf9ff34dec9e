"""Section 6.1: remapping."""
