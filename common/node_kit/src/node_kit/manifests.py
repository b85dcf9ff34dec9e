"""Files package.xml that keep every ROS program of a workspace from starting.

rospkg, and so rospy and roslaunch, reads all of them when it looks for any package; what it then
says names no file.
"""

import os
import sys
from pathlib import Path
from xml.etree import ElementTree


def broken_manifests(folder):
    """[(path, what is wrong)] of each package.xml below a folder that rospkg cannot read."""
    return list(_broken(Path(folder), set()))


def _broken(folder, above):
    here = os.path.realpath(folder)
    try:
        inside = {entry.name: entry for entry in os.scandir(folder)}
    except OSError:
        return
    if here in above or "CATKIN_IGNORE" in inside:
        return
    if "package.xml" in inside:
        complaint = _complaint(folder / "package.xml")
        if complaint:
            yield str(folder / "package.xml"), complaint
        return  # below a package there is none, says rospkg
    for name in sorted(inside):
        if os.path.isdir(inside[name].path):  # not is_dir(), which fails for a link to itself
            yield from _broken(folder / name, above | {here})


def _complaint(path):
    try:
        name = ElementTree.parse(path).findtext("name")
    except (ElementTree.ParseError, OSError, ValueError, LookupError) as error:
        return str(error)
    return "" if name is not None else "it has no <name>"


def main():
    """Name those below the folder of the command line; exit code 1 if there are any."""
    broken = broken_manifests(sys.argv[1])
    for path, complaint in broken:
        print(f"{path}: {complaint}")
    sys.exit(bool(broken))


if __name__ == "__main__":
    main()
