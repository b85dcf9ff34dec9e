"""What holds for every package: catkin's rules, versions, and that one file leads to the others."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]
PACKAGES = sorted(
    str(path.parent.relative_to(REPOSITORY))
    for pattern in ("*/package.xml", "common/*/package.xml")
    for path in REPOSITORY.glob(pattern)
    if path.parent.name != "test"
)


@pytest.mark.skipif(not shutil.which("catkin_lint"), reason="catkin_lint missing: ./tutorial setup")
def test_catkin_lint_finds_nothing():
    done = subprocess.run(
        ["catkin_lint", "--strict", "--offline", "-W2", *PACKAGES],
        cwd=REPOSITORY, capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("package", PACKAGES)
def test_version_is_the_newest_in_the_changelog(package):
    folder = REPOSITORY / package
    version = ElementTree.parse(folder / "package.xml").getroot().findtext("version")
    newest = re.search(r"^(\d+\.\d+\.\d+) ", (folder / "CHANGELOG.rst").read_text(), re.MULTILINE)
    assert newest and newest[1] == version


@pytest.mark.parametrize("package", PACKAGES)
def test_every_launch_argument_is_explained(package):
    for launch in sorted((REPOSITORY / package / "launch").glob("*.launch")):
        for arg in ElementTree.parse(launch).getroot().findall("arg"):
            if arg.get("value") is not None:
                continue  # fixed by the file itself
            assert arg.get("doc"), f"{launch.name}: {arg.get('name')}"
            explained = (REPOSITORY / package / "README.md").read_text()
            assert f"`{arg.get('name')}`" in explained, f"{launch.name}: {arg.get('name')}"


def test_links_lead_to_files_of_this_repository():
    links = [path for path in REPOSITORY.rglob("*") if path.is_symlink()]
    assert links  # the recording and the view, which stand in two packages
    for link in links:
        assert not os.readlink(link).startswith("/"), link
        assert REPOSITORY in link.resolve(strict=True).parents
