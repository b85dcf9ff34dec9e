"""What a student's files say, read and never run."""
