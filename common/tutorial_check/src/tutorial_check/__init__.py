"""Checks the exercises of the tutorial in a student's workspace: ./tutorial check.

The way through: program (command line) -> examination (starts the next one isolated) -> examine ->
exercises -> session -> box, driver. Results (model) come back, for report and formats.
"""
