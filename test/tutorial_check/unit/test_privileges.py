"""The user that runs students' programs."""

import pytest

from tutorial_check.sandbox.privileges import unused_user
from tutorial_testing.claims import claim


@claim("As root, programs run as a user that nobody else has")
@pytest.mark.parametrize(("uid_map", "lowest", "highest"), [
    ("         0          0 4294967295\n", 1_000_000, 1_999_999),  # a machine, or plain docker
    ("", 1_000_000, 1_999_999),  # a kernel that maps no ids
    ("0 1000 1\n1 100000 65536\n", 32_768, 65_533),  # podman of an ordinary user
    ("0 231072 65536\n", 32_768, 65_533),  # docker's userns-remap
])  # fmt: skip
def test_an_unused_uid_is_one_that_exists(tmp_path, uid_map, lowest, highest):
    file = tmp_path / "uid_map"
    file.write_text(uid_map)
    users = [unused_user(number, file) for number in (*range(20), 7_919, 65_537, 419_430_400)]
    assert lowest <= min(users) and max(users) <= highest
    assert len(set(users)) > 20


def test_where_all_uids_are_in_use_there_is_none(tmp_path):
    (tmp_path / "uid_map").write_text("0 1000 1\n1000 1000 1\n")
    assert unused_user(1, tmp_path / "uid_map") is None
