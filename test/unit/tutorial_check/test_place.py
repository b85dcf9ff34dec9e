"""Users and rights of programs; when one works without end."""

import os
import subprocess
import time
from types import SimpleNamespace

import pytest

from tutorial_check import box, place
from tutorial_check.box import processes
from tutorial_check.place import unused_user

@pytest.mark.parametrize(
    ("uid_map", "lowest", "highest"),
    [
        ("         0          0 4294967295\n", 1_000_000, 1_999_999),  # a machine, or plain docker
        ("", 1_000_000, 1_999_999),  # a kernel that maps no ids
        ("0 1000 1\n1 100000 65536\n", 32_768, 65_533),  # podman of an ordinary user
        ("0 231072 65536\n", 32_768, 65_533),  # docker's userns-remap
    ],
)
def test_an_unused_uid_is_one_that_exists(tmp_path, uid_map, lowest, highest):
    file = tmp_path / "uid_map"
    file.write_text(uid_map)
    users = [unused_user(number, file) for number in (*range(20), 7_919, 65_537, 419_430_400)]
    assert lowest <= min(users) and max(users) <= highest
    assert len(set(users)) > 20
    file.write_text("0 1000 1\n1000 1000 1\n")
    assert unused_user(1, file) is None


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can read as another user")
def test_root_opens_files_with_the_rights_of_the_programs_user(tmp_path, stranger):
    secret = tmp_path / "secret"
    secret.write_text("x")
    secret.chmod(0o600)
    place.touch_files_as(stranger, stranger)
    try:
        with pytest.raises(PermissionError):
            secret.read_text()
        with place.own_rights():
            assert secret.read_text() == "x"
        with pytest.raises(PermissionError):
            secret.read_text()
    finally:
        place.restore_rights()
    assert secret.read_text() == "x"


def test_a_process_with_a_name_of_any_bytes_is_listed(tmp_path):
    """Linux cuts it after 15 bytes, perhaps within a letter."""
    script = tmp_path / ("a" * 14 + "ü")
    script.write_text("#!/bin/sh\nread line\nexec sleep 3600\n")
    script.chmod(0o755)
    with subprocess.Popen([str(script)], stdin=subprocess.PIPE) as process:
        try:
            assert process.pid in {pid for pid, *_ in processes()}
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("least_s", "code", "spins"),
    [(0.0, None, True), (3600.0, None, False), (0.0, 0, False)],  # the last ended by itself
)
def test_a_program_that_works_and_gets_nowhere_spins(monkeypatch, least_s, code, spins):
    monkeypatch.setattr(box, "SPINNING_S", time.process_time() / 2 + least_s)
    program = box.Program(SimpleNamespace(pid=os.getpid(), poll=lambda: code), "this one")
    assert not program.spins
    program.stop(0)
    assert program.spins == spins
