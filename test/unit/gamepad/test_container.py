"""A container has an engine's mark and other namespaces than the machine."""

import pytest

from gamepad.driver.container import INITIAL, in_container


@pytest.mark.parametrize(
    ("marked", "own", "container"),
    [
        (True, "pid", True),
        (True, "uts", True),
        (True, "none", False),  # a virtual machine made from a container's image
        (True, "all", True),  # of a kernel without namespaces
        (False, "pid", False),  # a sandbox, such as the checker's
    ],
)
def test_a_container_has_a_mark_and_a_namespace_of_its_own(tmp_path, marked, own, container):
    folder = tmp_path / "proc" / "self" / "ns"
    folder.mkdir(parents=True)
    for kind, number in INITIAL.items() if own != "all" else ():
        (folder / kind).symlink_to(f"{kind}:[{4026532000 if kind == own else number}]")
    if marked:
        (tmp_path / ".dockerenv").touch()
    assert in_container(str(tmp_path)) is container
