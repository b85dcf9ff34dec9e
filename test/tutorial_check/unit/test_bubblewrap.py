"""Reports where programs cannot be isolated; exercises/test_isolation.py attacks the isolation."""

import contextlib
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

import pytest

from tutorial_check.cluster import dask_cluster as cluster
from tutorial_check.errors import CannotCheck
from tutorial_check.sandbox import bubblewrap, landlock
from tutorial_check.sandbox.bubblewrap import Isolation
from tutorial_testing.claims import claim
from tutorial_testing.isolation import old_bubblewrap


@claim("What the system does not provide is said first")
@pytest.mark.parametrize(("granted", "version", "words"), [
    (Isolation(why="bwrap: refused"), 0, "no isolation here (bwrap: refused): a program "),
    (Isolation(why="bwrap: refused"), 3, "isolated by Landlock alone (bwrap: refused): a "),
    (Isolation(("bwrap",)), 3, "does not limit the memory"),
    (Isolation(("bwrap",), is_limited=True), 0, ""),
])  # fmt: skip
def test_what_the_system_does_not_provide_is_reported(monkeypatch, granted, version, words):
    monkeypatch.setattr(bubblewrap, "granted", lambda: granted)
    monkeypatch.setattr(landlock, "version", lambda: version)
    assert words in "".join(bubblewrap.lacking())
    assert bool(bubblewrap.lacking()) == bool(words)


@pytest.mark.parametrize("why", ["bwrap: No permissions", "bubblewrap is not installed"])
def test_why_bubblewrap_does_not_work_is_known(monkeypatch, tmp_path, why):
    if "installed" not in why:
        (tmp_path / "bwrap").write_text(f"#!/bin/sh\necho {why} >&2; exit 1\n")
        (tmp_path / "bwrap").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(bubblewrap, "_granted", bubblewrap._granted.__wrapped__)
    assert bubblewrap.granted() == Isolation(why=why)


def test_threads_that_ask_at_once_get_one_answer(monkeypatch):
    both, asked = threading.Barrier(2), []

    def which(_name):
        asked.append(1)
        with contextlib.suppress(threading.BrokenBarrierError):
            both.wait(0.2)  # a second thread would release it; none comes

    monkeypatch.setattr(bubblewrap, "_granted", lru_cache()(bubblewrap._granted.__wrapped__))
    monkeypatch.setattr(bubblewrap.shutil, "which", which)
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(lambda _: bubblewrap.granted(), range(2))
    assert first is second and asked == [1]


NOT_ISOLATED = "cannot isolate programs: bwrap: refused: a student's program could reach the"


@claim("A student's program ...", because="a worker that cannot isolate")
@pytest.mark.parametrize(("begin", "why"), [
    (lambda: cluster.become_worker("tls://host", 1, False), NOT_ISOLATED),
    (lambda: cluster.become_worker("tcp://host", 1, True), "--not-isolated needs tls://, and root"),
    (lambda: cluster._examine(b"", None, ""), NOT_ISOLATED),  # not started by ./tutorial worker
])  # fmt: skip
def test_a_worker_without_isolation_checks_nothing(monkeypatch, begin, why):
    monkeypatch.setattr(bubblewrap, "granted", lambda: Isolation(why="bwrap: refused"))
    monkeypatch.delenv(cluster.INSISTS, raising=False)
    with pytest.raises(CannotCheck, match=why):
        begin()


def test_an_old_bubblewrap_isolates_and_everybody_may_write_into_tmp(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", old_bubblewrap(tmp_path), prepend=":")
    monkeypatch.setattr(bubblewrap, "_granted", lru_cache()(bubblewrap._granted.__wrapped__))
    if bubblewrap.granted().why:
        pytest.skip(f"no isolation here: {bubblewrap.granted().why}")
    assert "does not limit the memory" in "".join(bubblewrap.lacking())
    scratch = "/var/tmp/scratch"
    modes = ["stat", "-c", "%a", *bubblewrap.SIZES_MB, scratch, "/var"]
    words = [*bubblewrap.command(scratch, [], "/usr/share/doc"), *modes]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1777"] * 5 + ["755"]
