"""Packages besides the literal solution's, and other manifests of it."""

from edits import write


def manifest(name, format_="1", tags=""):
    """Return a package.xml of so many lines, with dependencies in the sixth."""
    attribute = f" format='{format_}'" if format_ != "1" else ""
    return f"""<package{attribute}>
<name>{name}</name><version>0.0.0</version>
<description>x</description>
<maintainer email="s@u.example">s</maintainer>
<license>x</license>
{tags}
</package>
"""


def depend(packages, *tags):
    """Return the lines of a package.xml that need packages, with each of these tags."""
    return "".join(f"<{tag}>{name}</{tag}>" for name in packages.split() for tag in tags)


def package(name, cmake, format_="1", tags=""):
    """Return the edits that make another package."""
    text = f"cmake_minimum_required(VERSION 3.5)\nproject({name})\n{cmake}\n"
    xml = manifest(name, format_, depend("catkin", "buildtool_depend") + tags)
    return [write(f"{name}/package.xml", xml), write(f"{name}/CMakeLists.txt", text)]
