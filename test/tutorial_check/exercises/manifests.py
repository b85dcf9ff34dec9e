"""Additional packages, and other manifests for the literal solution."""

from edits import write


def manifest(name, format_="1", tags=""):
    """Return a package.xml with the dependencies in its sixth line."""
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
    """Return dependencies on packages for a package.xml, with each of these tags."""
    return "".join(f"<{tag}>{name}</{tag}>" for name in packages.split() for tag in tags)


def package(name, cmake, format_="1", tags=""):
    """Return edits that make another package."""
    text = f"cmake_minimum_required(VERSION 3.5)\nproject({name})\n{cmake}\n"
    xml = manifest(name, format_, depend("catkin", "buildtool_depend") + tags)
    return [write(f"{name}/package.xml", xml), write(f"{name}/CMakeLists.txt", text)]
