"""Lesson 7, ours: a world."""
