"""--cluster: the same results as alone, whatever ends meanwhile. Each worker on a host of its own."""

import contextlib
import importlib.util
import json
import os
import re
import shutil
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest
from test_awkward import command, environment, examines
from test_mistakes import OF_HANDOUT
from test_mistakes import apply as change

from tutorial_check.examination import examine
from tutorial_testing.processes import Program, descendants
from tutorial_testing.two_hosts.network import Network
from tutorial_testing.waiting import wait_for

pytestmark = [
    pytest.mark.skipif(
        importlib.util.find_spec("distributed") is None,
        reason="no Dask here: ./tutorial check --cluster installs it",
    ),
    pytest.mark.skipif(os.geteuid() != 0, reason="not root: no hosts of a network of their own"),
]
HOSTS = {"teacher": "10.66.0.1", "one": "10.66.0.2", "two": "10.66.0.3", "three": "10.66.0.4"}
ADDRESS = f"tcp://{HOSTS['teacher']}:8786"
EXERCISE = "3"
RACE = "Twist for String"  # whichever of its two programs comes first decides what is wrong
ROWS = [row for row in OF_HANDOUT if row[0] == EXERCISE and row[1] != RACE]
JOBS = 4  # of a worker: they mostly wait
LONGEST_S = 7200.0  # a thousand take an hour


@pytest.fixture
def network():
    with Network(HOSTS) as found:
        yield found


@pytest.fixture
def start(network):
    """start(host, ...): a program on a host."""
    running = []

    def begin(host, *words):
        program = Program(*network[host].command(*map(str, words)), **environment())
        running.append(program)
        return program

    yield begin
    for program in running:
        program.__exit__()


@pytest.fixture
def scheduler(start):
    return lambda: _up(
        start("teacher", "/usr/bin/python3", "-m", "distributed.cli.dask_scheduler",
              "--host", HOSTS["teacher"], "--no-dashboard")
    )  # fmt: skip


def _up(scheduler):
    wait_for(lambda: "Scheduler at" in scheduler.output, "a scheduler", 60)
    return scheduler


@pytest.fixture
def worker(start, underlay, monkeypatch):
    monkeypatch.setenv("TUTORIAL_UNDERLAY", underlay)
    words = "/usr/bin/python3", "-m", "tutorial_check.cluster", ADDRESS, "--jobs"
    return lambda host, jobs=JOBS: start(host, *words, jobs)


@pytest.fixture
def client(start, underlay):
    return lambda folder: start(
        "teacher", *command(underlay, "--all", folder, EXERCISE, "--cluster", ADDRESS)
    )


def kill(program):
    for pid in [program.pid, *descendants(program.pid)]:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def hand_in(literal, folder, count):
    """A class of so many, with the mistakes of all rows in turn; {name: index of the row}."""
    rows = ROWS[:: max(1, len(ROWS) // count)]
    made = {}
    for number in range(count):
        name, index = f"student_{number:04}", number % len(rows)
        path = folder / name
        if number < len(rows):
            shutil.copytree(literal.parent, path)
            change(rows[index][2], path / "src")
        else:
            shutil.copytree(folder / f"student_{index:04}", path, symlinks=True)
        made[name] = index
    return made


def plain(results):
    """What is to be the same: all but times and other numbers that were measured."""
    names = ("id", "status", "title", "expected", "where", "hint")
    return [
        (*(one[name] for name in names), re.sub(r"[0-9.]+", "#", one["seen"])) for one in results
    ]


def checked(folder):
    return list((folder / "check").glob("student_*.json"))


def alone(path, underlay):
    """The results of a submission on this machine, as the JSON file has them."""
    (outcome,) = examine(path, underlay, [EXERCISE], own=False)
    return plain([vars(one) for one in outcome.results])


def compared(folder, rows, expected):
    """How many reports have the same words; all must have the same verdicts."""
    same = 0
    for name, index in rows.items():
        report = json.loads((folder / "check" / f"{name}.json").read_text())
        found = plain(report["exercises"][0]["checks"])
        assert [one[:3] for one in found] == [one[:3] for one in expected[index]], name
        same += found == expected[index]
    return same


def test_one_worker_is_killed_and_one_added(
    literal, underlay, tmp_path, scheduler, worker, client, request
):
    """Also a scheduler that is killed: one line, and the next call goes on from there."""
    folder = tmp_path / "class"
    count = request.config.getoption("--submissions")
    rows = hand_in(literal, folder, count)
    first = scheduler()
    workers = [worker("one"), worker("two")]
    call = client(folder)
    wait_for(lambda: len(checked(folder)) >= count // 4, "a quarter", LONGEST_S)
    kill(workers[0])
    workers.append(worker("three"))
    wait_for(lambda: len(checked(folder)) >= count // 2, "half", LONGEST_S)
    kill(first)
    assert call.wait(120) == 2, call.output
    lines = [line for line in call.output.splitlines() if line.startswith("check: ")]
    assert lines == [f"check: no verdict: the scheduler at {ADDRESS} is gone; call again, and it goes on from here"]  # fmt: skip
    assert "Traceback" not in call.output
    done = len(checked(folder))
    for each in workers[1:]:
        kill(each)
    scheduler()
    workers = [worker("two"), worker("three")]
    call = client(folder)
    assert call.wait(LONGEST_S) == 1, call.output
    assert call.output.count("unchanged since the last check") >= min(done, count // 2)
    assert len(checked(folder)) == count
    with ThreadPoolExecutor(2) as pool:
        firsts = {index: name for name, index in reversed(rows.items())}
        found = pool.map(lambda name: alone(folder / name, underlay), firsts.values())
        expected = dict(zip(firsts, found))
    same = compared(folder, rows, expected)
    assert same >= 0.98 * count  # of a talker that ends at once the one message is heard, or not


def test_a_client_that_is_killed_goes_on_where_it_was(literal, tmp_path, scheduler, worker, client):
    folder = tmp_path / "class"
    hand_in(literal, folder, 6)
    scheduler()
    for host in ("one", "two"):
        worker(host)
    call = client(folder)
    wait_for(lambda: checked(folder), "a first report", LONGEST_S)
    kill(call)
    done = len(checked(folder))
    assert done < 6
    call = client(folder)
    assert call.wait(LONGEST_S) == 1, call.output
    assert (
        call.output.count("unchanged since the last check") >= done - 1
    )  # the last may be half written
    assert len(checked(folder)) == 6 and "Traceback" not in call.output


def test_a_submission_that_ends_workers_is_abandoned(literal, tmp_path, scheduler, worker, client):
    """Killed each time it has begun to check it, as by the kernel when memory is short."""
    folder = tmp_path / "class"
    shutil.copytree(literal.parent, folder / "ada")
    scheduler()
    call = client(folder)
    for host in ("one", "two"):
        each = worker(host, 1)  # of several, a second one may get it before that is killed, too
        wait_for(lambda each=each: examines(each), "an examination", 120)
        kill(each)
    assert call.wait(120) == 2, call.output
    assert "abandoned: 2 workers have ended while they checked it" in call.output


def test_nobody_listens(literal, underlay, client, start):
    call = client(literal.parent.parent)
    assert call.wait(60) == 2
    assert f"check: no verdict: no Dask scheduler at {ADDRESS}: " in call.output
    call = start("one", "/usr/bin/python3", "-m", "tutorial_check.cluster", "127.0.0.1:1")
    assert call.wait(60) == 1
    assert call.output == "worker: no Dask scheduler at 127.0.0.1:1: Connection refused\n"
