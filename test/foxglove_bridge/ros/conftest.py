"""The packages of npm are fetched before a rostest, whose network has no way out."""

from tutorial_testing.npm import modules


def pytest_runtest_setup():
    modules()
