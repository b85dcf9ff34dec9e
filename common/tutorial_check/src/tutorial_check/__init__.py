"""Checks the exercises of the tutorial in a student's workspace: ./tutorial check.

command_line -> launcher (starts the next one isolated) -> worker -> handout: record -> judge.
Results (model) come back to the launcher, for report.
"""
