"""Checks the exercises of the tutorial in a student's workspace: ./tutorial check.

command_line -> launcher -> handout/.../judge, which asks for a recording -> worker, isolated ->
handout/.../record. What was recorded comes back, and becomes results (model) for report.
"""
