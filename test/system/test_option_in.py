"""--in WORKSPACE: what it refuses, and what it says of a workspace that is broken."""

import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    ("folder", "line"),
    [
        ("{home}/a b", "without spaces"),
        ("{repository}", "the suite's own"),
        ("{repository}/joy2twist", "this is a package"),
        ("/proc/ws", "cannot be made"),
    ],
)
def test_a_wrong_workspace_is_one_line(tmp_path, tutorial, folder, line):
    folder = folder.format(home=tmp_path, repository=REPOSITORY)
    done = subprocess.run(
        [tutorial, "run", "--in", folder, "true"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == 1
    assert line in done.stderr


def test_a_broken_package_xml_is_named_before_everything_fails_over_it(tutorial, tmp_path):
    package = tmp_path / "src" / "mine" / "package.xml"
    command = [tutorial, "run", "--in", str(tmp_path), "true"]
    assert subprocess.run(command, check=False).returncode == 0
    package.parent.mkdir(parents=True)
    package.write_text("<package>\n<name>mine</nam>\n</package>")
    said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    assert said.count("\n") == 1 and f"{package}: mismatched tag: line 2" in said
    doctor = [tutorial, "doctor", "--in", str(tmp_path)]
    told = subprocess.run(doctor, capture_output=True, text=True, check=False).stdout
    assert f"wrong    overlay   {package}: mismatched tag: line 2" in told


@pytest.mark.parametrize(
    ("word", "told"),
    [("demo", "demo: knows no --in"), ("chek", '"chek" is not a word of this command')],
)
def test_what_knows_no_in(tutorial, word, told):
    command = [tutorial, word, "--in", "/tmp"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, told in done.stderr) == (1, True)
