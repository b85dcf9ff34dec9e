"""What is in the way of a robot: walls, posts, cliffs (pure)."""
