"""What one looks at the suite with: the demonstration, the doctor, the picture of the graph."""
