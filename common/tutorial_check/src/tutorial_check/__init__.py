"""Checks the exercises of the tutorial in a student's workspace: ./tutorial check.

The way through: program (command line) -> examination (starts the next one, apart from the rest of
the machine) -> examine -> exercises -> session -> box, driver. What they find goes back as results
(model), which report and formats put into words and files.
"""
