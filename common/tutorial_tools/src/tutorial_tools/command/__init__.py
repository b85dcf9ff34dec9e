"""What ./tutorial runs once Python is installed: its words, and the build."""
