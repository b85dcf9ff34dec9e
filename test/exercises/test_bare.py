"""Where the system grants no namespaces, as most containers: the same verdicts, or none and why."""

import os
from pathlib import Path

import pytest
from test_awkward import check
from test_endings import path_without_namespaces


@pytest.fixture(autouse=True)
def bare(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", path_without_namespaces(tmp_path))


@pytest.mark.night
def test_right_is_right_or_not_judged_without_namespaces(literal, underlay):
    """Where the suite is below root's home folder, launch files of another user cannot name it."""
    others_may_enter = all(folder.stat().st_mode & 0o001 for folder in Path(underlay).parents)
    code, out, error = check(underlay, "--in", literal.parent, "2", "3", "4", "5")
    assert code == (0 if os.geteuid() or others_may_enter else 2), out + error
    assert "WRONG" not in out


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can run programs as another user")
@pytest.mark.night
def test_nobody_is_blamed_where_programs_may_not_enter(literal, underlay, tmp_path):
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o700)
    tmp_path.chmod(0o755)
    (closed / "setup.bash").write_text(f". {underlay}\n")
    code, out, error = check(closed / "setup.bash", "--in", literal.parent, "5")
    assert code == 2, out + error
    assert "WRONG" not in out
    assert "closed to others" in error and "TUTORIAL_WORKSPACE" in error
