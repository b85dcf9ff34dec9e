"""Two ./tutorial at once: one builds, the other reports that it waits."""

import fcntl
import threading

from tutorial_testing.waiting import wait_for
from tutorial_tools.io.command import lock


def waits(said):
    return lock.WAITS in "".join(said)


def test_who_waits_for_a_build_says_so(tmp_path, capsys):
    said, done = [], threading.Event()

    def build_too():
        with lock.one_at_a_time(tmp_path):
            done.set()

    with open(tmp_path / "lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        waiter = threading.Thread(target=build_too)
        waiter.start()
        wait_for(lambda: said.append(capsys.readouterr().err) or waits(said), "a line")
        assert not done.is_set()
    waiter.join(30)
    assert done.is_set()


def test_a_short_wait_is_not_worth_a_line(tmp_path, capsys):
    with open(tmp_path / "lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        threading.Timer(0.1, lambda: fcntl.flock(file, fcntl.LOCK_UN)).start()
        with lock.one_at_a_time(tmp_path):
            assert not capsys.readouterr().err


def test_who_does_not_wait_says_nothing(tmp_path, capsys):
    with lock.one_at_a_time(tmp_path):
        assert not capsys.readouterr().err
