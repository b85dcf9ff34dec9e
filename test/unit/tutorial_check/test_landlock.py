"""Where Landlock is used; test/exercises/test_isolation.py has the attacks on it."""

import platform

from tutorial_check.isolation import landlock


def test_landlock_is_not_used_where_the_machine_or_the_kernel_is_unknown(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert landlock.version.__wrapped__() == 0
    monkeypatch.undo()
    monkeypatch.setattr(landlock, "OLDEST", 1000)
    assert landlock.version.__wrapped__() == 0
