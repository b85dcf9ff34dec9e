"""What students, professors and services read."""
