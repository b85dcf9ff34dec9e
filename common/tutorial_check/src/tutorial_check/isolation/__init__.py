"""What keeps a student's programs to themselves: users, rights, limits, processes."""
