"""What the tests of courses share with the checker's."""

from tutorial_testing.submissions import make_submission, order  # noqa: F401
