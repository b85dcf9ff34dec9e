"""Which machine this is."""

import pytest

from node_kit.io.machine import INITIAL, in_container


@pytest.mark.parametrize(
    ("marked", "own", "container"),
    [
        (True, "pid", True),
        (True, "none", False),  # a virtual machine made from a container's image
        (True, "all", True),  # a kernel without namespaces
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
