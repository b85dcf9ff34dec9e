"""The package that an exercise is about."""

from __future__ import annotations

from tutorial_check.checking.manifest_errors import must_be_unique, unreadable
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission
from tutorial_check.submission.packages import Package


def package_of(submission: Submission, name: str) -> Package:
    """Return the package of that name. Raises Wrong."""
    if not submission.has(name):
        there = ", ".join(package.name for package in submission.packages) or "no package at all"
        depends = submission.course.packages.get(name, "rospy")
        raise Wrong(f"a package {name} in src", there, hint=f"catkin_create_pkg {name} {depends}")
    return submission.package(name)


def must_be_launchable(submission: Submission) -> None:
    """Raise Wrong for a package.xml that catkin refuses: roslaunch then starts nothing."""
    if submission.broken:
        raise unreadable(submission.broken)
    for package in submission.packages:
        if package.error:
            raise unreadable(package)
    for package in submission.packages:
        must_be_unique([other for other in submission.packages if other.name == package.name])
