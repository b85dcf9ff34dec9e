"""The package that an exercise is about."""

from __future__ import annotations

from tutorial_check.checking.results import Wrong
from tutorial_check.course.definition import read_course
from tutorial_check.submission.files import Session
from tutorial_check.submission.packages import Package


def package_of(session: Session, name: str) -> Package:
    """Return the package of that name. Raises Wrong."""
    if not session.has(name):
        there = ", ".join(each.name for each in session.packages) or "no package at all"
        depends = read_course(session.order.course).packages.get(name, "rospy")
        raise Wrong(f"a package {name} in src", there, hint=f"catkin_create_pkg {name} {depends}")
    return session.package(name)
