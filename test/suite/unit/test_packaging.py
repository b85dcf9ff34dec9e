"""What holds for every package: versions, declarations, sizes of files, and who may do what."""

import ast
import re
import subprocess
import sys
import sysconfig
from collections import Counter
from importlib.util import find_spec
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from tutorial_testing.claims import claim
from tutorial_testing.processes import REPOSITORY

PACKAGES = sorted(
    str(path.parent.relative_to(REPOSITORY))
    for pattern in ("*/package.xml", "common/*/package.xml")
    for path in REPOSITORY.glob(pattern)
    if path.parent.name != "test"
)


@claim("Package versions, launch arguments and imports are declared where they should be")
@pytest.mark.parametrize("package", PACKAGES)
def test_version_is_the_newest_in_the_changelog(package):
    folder = REPOSITORY / package
    version = ElementTree.parse(folder / "package.xml").getroot().findtext("version")
    newest = re.search(r"^(\d+\.\d+\.\d+) ", (folder / "CHANGELOG.rst").read_text(), re.MULTILINE)
    assert newest and newest[1] == version


@claim("Package versions, launch ...", because="launch arguments")
@pytest.mark.parametrize("package", PACKAGES)
def test_every_launch_argument_is_explained(package):
    for launch in sorted((REPOSITORY / package / "launch").glob("*.launch")):
        for arg in ElementTree.parse(launch).getroot().findall("arg"):
            explained = (REPOSITORY / package / "README.md").read_text()
            is_explained = arg.get("doc") and f"`{arg.get('name')}`" in explained
            is_fixed = arg.get("value") is not None  # by the file itself
            assert is_fixed or is_explained, f"{launch.name}: {arg.get('name')}"


ROOTS = ("*", "common/*", "common/stand_ins/*")
FOLDERS = (*(f"{root}/src" for root in ROOTS), "test/support")
SOURCES = [path for folder in FOLDERS for path in REPOSITORY.glob(f"{folder}/**/*.py")]
SCRIPTS = [*REPOSITORY.glob("*/scripts/*"), *REPOSITORY.glob("common/*/scripts/*")]
SCRIPTS = [path for path in SCRIPTS if path.is_file()]
# Import name -> the name in package.xml, where they differ.
DEBIAN = {
    "cockpit_server": "cockpit", "joy_to_twist": "joy2twist", "kobuki_driver": "kobuki_node",
    "foxglove_bridge_server": "foxglove_bridge",
    "PIL": "python3-pil",
    **{name: f"python3-{name}" for name in (
        "evdev", "matplotlib", "serial", "numpy", "rospkg", "tornado", "tqdm", "yaml")},
}  # fmt: skip
UNDECLARED = {"rosbags", "rclpy", "foxglove"}  # PyPI's, which package.xml cannot name


@claim("Package versions, launch ...", because="imports")
@pytest.mark.parametrize("package", [p for p in PACKAGES if p != "common/tutorial_check"])
def test_what_is_imported_is_declared(package):
    root = ElementTree.parse(REPOSITORY / package / "package.xml").getroot()
    declared = {part.text for part in root if part.tag in ("depend", "exec_depend")}
    own = root.findtext("name")
    for path in (REPOSITORY / package).glob("src/**/*.py"):
        for name in imported_packages(path):
            if path.with_name(f"{name}.py").exists():
                continue  # a program for the Python of ROS 2, which imports the file beside it
            needed = DEBIAN.get(name, name)
            assert is_of_python(name) or needed in {own, *declared, *UNDECLARED}, f"{path}: {name}"


def imported_packages(path):
    for statement in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(statement, ast.Import):
            yield from (alias.name.split(".")[0] for alias in statement.names)
        elif isinstance(statement, ast.ImportFrom):
            yield statement.module.split(".")[0]


def is_of_python(name):
    origin = getattr(find_spec(name), "origin", None) or ""
    standard = origin.startswith(sysconfig.get_paths()["stdlib"]) and "-packages" not in origin
    return standard or origin in ("built-in", "frozen")


@claim("A file is read in five minutes")
@pytest.mark.parametrize("path", [*SOURCES, *SCRIPTS], ids=lambda path: path.name)
def test_a_file_is_read_in_five_minutes_and_a_script_only_starts_its_program(path):
    is_start = path in SCRIPTS and path.parts[-3] != "beginner_tutorials"
    most = 20 if is_start else 300
    assert len(path.read_text(encoding="utf-8").splitlines()) <= most


def test_class_names_are_unique_and_variables_are_nouns():
    """NewJoy2Twist is the handout's class, once for ROS 1 and once for ROS 2."""
    paths = [path for path in SOURCES if "test" not in path.relative_to(REPOSITORY).parts]
    nodes = [node for path in paths for node in ast.walk(ast.parse(path.read_text("utf-8")))]
    classes = Counter(node.name for node in nodes if isinstance(node, ast.ClassDef))
    shared = {name for name, count in classes.items() if count > 1 and name[0] != "_"}
    assert shared <= {"NewJoy2Twist"}
    names = {getattr(node, "id", getattr(node, "arg", "")) for node in nodes}
    assert not names.intersection(("one", "each", "found"))


def test_no_class_of_the_checker_has_more_than_twelve_attributes():
    for path in REPOSITORY.glob("common/tutorial_check/src/**/*.py"):
        nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        for kind in (node for node in nodes if isinstance(node, ast.ClassDef)):
            fields = {node.target.id for node in kind.body if isinstance(node, ast.AnnAssign)}
            stored = (node for node in ast.walk(kind) if isinstance(node, ast.Attribute))
            stored = (node for node in stored if isinstance(node.ctx, ast.Store))
            own = {node.attr for node in stored if getattr(node.value, "id", "") == "self"}
            assert len(fields | own) <= 12, f"{path}: {kind.name}"


@claim("pip installs no ...", because="only what a lock has")
def test_pip_installs_only_what_a_lock_has():
    """A lock, which test/lock writes, has all requirements, and each release its hashes."""
    locks = dict(re.findall(r'"(\w+)": \("(\S+)"', (REPOSITORY / "test/lock").read_text()))
    assert len(locks) == len(list((REPOSITORY / "test/locks").glob("*.txt"))) >= 5
    for name, requirements in locks.items():
        text = (REPOSITORY / "test/locks" / f"{name}.txt").read_text()
        pattern = r"^([\w-]+)(?:\[\w+\])?(==[\w.]+)"
        required = re.findall(pattern, (REPOSITORY / requirements).read_text(), re.M)
        assert set(map("".join, required)) <= set(re.findall(r"^\w\S*", text, re.M)), name
        for entry in re.split(r"\n(?=\w)", text)[1:]:
            assert re.search(r"--hash=sha256:[0-9a-f]{64}", entry), entry
    words = (REPOSITORY / "common/tutorial_tools/src/tutorial_tools/command").glob("*.py")
    files = r"\b(test/\S+requirements\S*\.txt|common/\S+\.txt)"
    named = set(re.findall(files, "".join(map(Path.read_text, words))))
    assert named - {"test/requirements-{kind}.txt"} <= set(locks.values())


def test_ci_has_an_environment_like_a_users():
    """It keeps what the network needs; PYTHONUNBUFFERED would hide a test that waits for a pipe."""
    path, kept = "/usr/bin:/bin", {"PIP_CERT": "a", "https_proxy": "b", "TUTORIAL_JOBS": "1"}
    left = ("PYTHONUNBUFFERED", "PYTHONDONTWRITEBYTECODE", "DEBIAN_FRONTEND", "USER", "CERTAIN")
    given = {**kept, **dict.fromkeys(left, "1"), "HOME": "/h", "PATH": path, "LANG": "C"}
    command = [REPOSITORY / ".ci/as_user", "env", "-0"]
    said = subprocess.run(command, env=given, stdout=subprocess.PIPE, text=True, check=True).stdout
    environment = dict(line.split("=", 1) for line in said.split("\0")[:-1])
    assert environment.pop("PATH").endswith("/usr/sbin:/usr/bin:/sbin:/bin")
    assert environment == {**kept, "HOME": "/h", "LANG": "C", "TERM": "dumb"}
    assert '/as_user" "${BASH_SOURCE[0]}"' in (REPOSITORY / ".ci/run").read_text()


@claim("Workflows may only read, and take actions by their commit")
def test_workflows_may_only_read_and_take_actions_by_their_commit():
    made = REPOSITORY / "common/tutorial_check/src/tutorial_check/commands/autograder/check.yml"
    for text in map(Path.read_text, [made, *(REPOSITORY / ".github/workflows").glob("*.yml")]):
        assert re.search(r"^permissions: \{contents: read\}$", text, re.M)
        fixed = re.findall(r"\buses: [\w-]+/[\w-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+$", text, re.M)
        assert len(re.findall(r"\buses: ", text)) == len(fixed)


@claim("The compose files open nothing to other machines")
@pytest.mark.parametrize("name", ["compose.yaml", "two_hosts.yaml"])
def test_nothing_of_a_container_is_open_to_other_machines(name):
    for service in yaml.safe_load((REPOSITORY / "docker" / name).read_text())["services"].values():
        assert service["image"] == "ros1_tutorial"
        assert not {"privileged", "network_mode", "cap_add", "devices"} & set(service)
        assert all(port.startswith("127.0.0.1:") for port in service.get("ports", []))
        assert service["cap_drop"] == ["ALL"]
        assert service["security_opt"] == ["no-new-privileges:true"]
        assert service["pids_limit"] and service["mem_limit"]


@claim("No program and no test needs more than Python 3.8")
@pytest.mark.skipif(not find_spec("vermin"), reason="vermin missing: ./tutorial setup")
def test_no_program_and_no_test_needs_more_than_python_3_8():
    """As far as vermin (PyPI) can tell; ruff (FA102) finds annotations that 3.8 evaluates."""
    options = ["--target=3.8-", "--violations", "--no-eval-annotations", "--no-tips", "--quiet"]
    vermin = [sys.executable, "-c", "import vermin; vermin.main()", *options]
    folders = {REPOSITORY / package.split("/")[0] for package in PACKAGES}
    tests = (REPOSITORY / "test").glob("**/*.py")
    done = subprocess.run([*vermin, *folders, *tests], capture_output=True, text=True, check=False)
    assert not done.returncode, done.stdout + done.stderr


UNIT_TESTS = [
    path for path in REPOSITORY.glob("test/*/unit/test_*.py") if path.parts[-3] != "suite"
]


@pytest.mark.parametrize("test", UNIT_TESTS, ids=lambda path: path.stem)
def test_a_unit_test_is_named_for_its_module_or_folder_of_modules(test):
    """Or FOLDER_MODULE, where several modules have the same name, such as parameters."""
    places = [f"{root[:-1]}{test.parts[-3]}/**/*" for root in (*ROOTS, "test/*")]
    paths = [path for place in places for path in REPOSITORY.glob(place)]
    names = {name for path in paths for name in (path.stem, f"{path.parent.name}_{path.stem}")}
    assert test.stem.partition("_")[2] in names
