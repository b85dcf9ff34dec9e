"""The checks of the handout's exercises, and of a lesson of our own: a course like any other."""
