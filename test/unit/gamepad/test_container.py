"""A container has an engine's mark and other namespaces than the machine."""

import pytest

from gamepad.driver.container import INITIAL, in_container


@pytest.mark.parametrize(
    ("marked", "own", "container"),
    [
        (True, "pid", True),
        (True, "uts", True),
        (True, None, False),  # a virtual machine made from a container's image
        (False, "pid", False),  # a sandbox, such as the checker's
    ],
)
def test_a_mark_and_a_namespace_of_its_own(tmp_path, marked, own, container):
    folder = tmp_path / "proc" / "self" / "ns"
    folder.mkdir(parents=True)
    for kind, number in INITIAL.items():
        (folder / kind).symlink_to(f"{kind}:[{4026532000 if kind == own else number}]")
    if marked:
        (tmp_path / ".dockerenv").touch()
    assert in_container(str(tmp_path)) is container


def test_a_kernel_without_namespaces(tmp_path):
    (tmp_path / ".dockerenv").touch()
    assert in_container(str(tmp_path))
