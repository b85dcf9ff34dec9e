"""The list of packages for a ROS in /opt/ros: what Noetic's packages install, and what is missing.

Most package.xml of Noetic are in Debian's packages; the metapackages are those of REP 150.
"""

import re
from xml.etree import ElementTree

import pytest

from tutorial_testing.claims import claim
from tutorial_testing.noetic import META
from tutorial_testing.processes import REPOSITORY
from tutorial_tools.command.requirements import names_of
from tutorial_tools.io.command.build import lock_of
from tutorial_tools.io.system import packages as system_packages
from tutorial_tools.paths import SHARE

pytestmark = claim(
    "Over a ROS in /opt/ros, ros-base and the listed packages are all that the demo needs"
)
NOETICS = {*META, *" ".join(META.values()).split(), "diagnostic_updater", "tf_conversions"}
NOETICS |= {path.parent.name for path in SHARE.glob("*/package.xml")}
SUITE = {
    ElementTree.parse(path).findtext("name"): path
    for pattern in ("*/package.xml", "common/*/package.xml", "common/stand_ins/*/package.xml")
    for path in REPOSITORY.glob(pattern)
    if not path.with_name("CATKIN_IGNORE").exists()
}
RUN = ("depend", "exec_depend", "run_depend", "build_export_depend", "buildtool_export_depend")
BUILD = ("depend", "build_depend", "buildtool_depend")
WITHOUT = {"rviz"}  # [opt-view]; the demo works without it


def needed_by(manifest, tags):
    """Return the dependencies of a package.xml under Python 3."""
    parts = (part for part in ElementTree.parse(manifest).getroot() if part.tag in tags)
    return {part.text for part in parts if "== 2" not in part.get("condition", "")}


def closure(names, manifests):
    """Return all packages that these names install. manifests: {name: path}."""
    brought, left = set(), set(names)
    while left:
        name = left.pop()
        brought.add(name)
        more = set(META.get(name, "").split())
        if name in manifests:
            more |= needed_by(manifests[name], RUN)
        left |= more - brought
    return brought


@pytest.fixture
def brought(monkeypatch):
    """brought(section, ...): what [opt-...] installs on Noetic, by the names in package.xml."""
    monkeypatch.setenv("TUTORIAL_ROS", "/opt/ros/noetic")
    monkeypatch.delenv("TUTORIAL_WITHOUT", raising=False)
    manifests = {path.parent.name: path for path in SHARE.glob("*/package.xml")}

    def keys(*sections):
        words = system_packages.packages(*sections)
        prefix = "ros-noetic-"
        names = {word[len(prefix) :].replace("-", "_") for word in words if word.startswith(prefix)}
        return closure(names, manifests) | {word for word in words if not word.startswith(prefix)}

    return keys


def test_what_the_demo_starts_and_the_build_needs_is_brought_by_opt_demo(brought):
    started = closure({"joy2twist", "tutorial_tools"}, SUITE)
    built = set().union(*(needed_by(path, BUILD) for path in SUITE.values()))
    needed = {name for name in started | built if name not in SUITE} - WITHOUT
    assert {"diagnostic_updater", "robot_state_publisher", "message_generation"} <= needed
    assert (needed & NOETICS) - brought("demo") == set()
    other = needed - NOETICS - {"python3-matplotlib"}  # for pictures of paths, in [opt-test]
    assert other - brought("demo", "more") == set()


@pytest.mark.parametrize("section", ["demo", "more"])
def test_what_a_section_has_beside_ros_it_has_for_opt_too(brought, section, monkeypatch):
    of_opt = brought("demo", section)
    monkeypatch.setenv("TUTORIAL_ROS", "")
    ros = "|".join(name.replace("_", "-") for name in NOETICS)
    ours = re.compile(rf"lib.*-dev|ros-.*|(python3-)?({ros})(-tools)?|qt6-.*|rviz")
    beside = {word for word in system_packages.packages(section) if not ours.fullmatch(word)}
    assert {"cmake", "make", "g++"} <= beside or section != "demo"
    assert beside - of_opt - {"libgl1-mesa-dri"} == set()  # RViz of Noetic brings it


@claim("Where the archive ...", because="zstandard")
@pytest.mark.parametrize(("minor", "has_it"), [(8, True), (10, True), (11, False)])
def test_zstandard_comes_from_pypi_where_older_archives_lack_it(minor, has_it):
    """rosbags, and so replay_bag, needs it."""
    names = names_of((REPOSITORY / "test/requirements.txt").read_text(), minor)
    assert ("zstandard" in names) == has_it and names.count("rosbags") == 1
    lock = lock_of("python").read_text()
    (entry,) = re.findall("^zstandard==.*", lock, re.M)
    assert entry.count("--hash=") >= 2 * 3  # wheels of two processors, for Python 3.8 to 3.10
