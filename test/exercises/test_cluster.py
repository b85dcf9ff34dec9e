"""--cluster: the same results as alone, whatever ends meanwhile. Each worker on a host of its own."""

import contextlib
import importlib.util
import json
import os
import re
import shutil
import signal
import subprocess
from concurrent.futures import ThreadPoolExecutor

import pytest
from test_awkward import command, environment, examines
from test_endings import path_without_namespaces
from test_mistakes import OF_HANDOUT
from test_mistakes import apply as change

from tutorial_check.examination import examine
from tutorial_testing.processes import Program, command_line, descendants
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
ADDRESS = f"tls://{HOSTS['teacher']}:8786"
MACHINES = ("/usr/bin/python3", "-m", "tutorial_check.cluster")
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


@pytest.fixture(autouse=True)
def key(tmp_path, monkeypatch):
    """The key of a cluster of its own, where the programs of students cannot get it."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return tmp_path / "config/ros1_tutorial/cluster.pem"


@pytest.fixture
def scheduler(start):
    return lambda: _up(start("teacher", *MACHINES, "scheduler", "--host", HOSTS["teacher"]))


def _up(scheduler):
    wait_for(lambda: "Scheduler at" in scheduler.output, "a scheduler", 60)
    return scheduler


@pytest.fixture
def worker(start, underlay, monkeypatch):
    monkeypatch.setenv("TUTORIAL_UNDERLAY", underlay)
    words = *MACHINES, "worker", ADDRESS, "--jobs"
    return lambda host, jobs=JOBS, *more: start(host, *words, jobs, *more)


@pytest.fixture
def client(start, underlay):
    return lambda folder: start(
        "teacher", *command(underlay, "--all", folder, EXERCISE, "--cluster", ADDRESS)
    )


def kill(program):
    """End all at once, but for what removes folders: as if memory is short."""
    for pid in [each for each in descendants(program.pid) if "rm -rf" not in command_line(each)]:
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


def test_nobody_listens(literal, client, start, key):
    key.parent.mkdir(parents=True)
    key.touch()
    call = client(literal.parent.parent)
    assert call.wait(60) == 2
    assert f"check: no verdict: no Dask scheduler at {ADDRESS}: " in call.output
    call = start("one", *MACHINES, "worker", "127.0.0.1:1")
    assert call.wait(60) == 1
    assert call.output == "worker: no Dask scheduler at 127.0.0.1:1: Connection refused\n"


# Of a student's program: it reads the key, and runs code where that leads.
ATTACK = """
import os
try:
    from distributed import Client
    from distributed.security import Security
    key = dict.fromkeys(("tls_ca_file", "tls_client_cert", "tls_client_key"), {key!r})
    client = Client({address!r}, timeout=5, security=Security(**key, require_encryption={encrypted}))
    client.run_on_scheduler(lambda path: open(path, "w").close(), {owned!r})
except BaseException as error:
    print(repr(error))
"""


@pytest.mark.parametrize("how", ["isolated", "insists"])
def test_a_students_program_does_not_reach_the_scheduler(
    literal, tmp_path, scheduler, worker, client, key, monkeypatch, how
):
    """Of a worker that insists each result says so."""
    folder, owned = tmp_path / "class", tmp_path / "owned"
    shutil.copytree(literal.parent, folder / "ada")
    about = {"key": str(key), "address": ADDRESS, "owned": str(owned), "encrypted": True}
    talker = folder / "ada/src/beginner_tutorials/scripts/talker.py"
    first, rest = talker.read_text().split("\n", 1)
    talker.write_text(f"{first}\n{ATTACK.format(**about)}\n{rest}")
    scheduler()
    more = ()
    if how == "insists":
        monkeypatch.setenv("PATH", path_without_namespaces(tmp_path))
        more = ("--not-isolated",)
    worker("one", 1, *more)
    monkeypatch.undo()
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    call = client(folder)
    assert call.wait(300) in (0, 1), call.output
    assert not owned.exists()
    report = (folder / "check/ada.txt").read_text()
    assert ("isolated by Landlock alone" in report or "not isolated" in report) == (
        how == "insists"
    )


def test_a_worker_that_cannot_isolate_refuses_to_start(tmp_path, start, monkeypatch):
    monkeypatch.setenv("PATH", path_without_namespaces(tmp_path))
    for words, why in (
        ((ADDRESS,), "bwrap fails: a student's program could reach the"),
        (
            (ADDRESS.replace("tls", "tcp"), "--not-isolated"),
            "--not-isolated needs tls://, and root",
        ),
    ):
        call = start("one", *MACHINES, "worker", *words)
        assert call.wait(60) == 1
        assert why in call.output and call.output.count("\n") == 1


def test_who_has_no_key_is_not_let_in(
    tmp_path, scheduler, worker, client, key, network, monkeypatch
):
    """Neither does anything listen on all addresses, nor on loopback for pages with logs."""
    scheduler()
    programs = [worker("one", 1), worker("two", 1)]
    wait_for(lambda: all("Registered to" in each.output for each in programs), "workers", 60)
    for host in ("teacher", "one"):
        lines = subprocess.check_output(network[host].command("ss", "-Hltn"), text=True)
        places = [line.split()[3].rsplit(":", 1) for line in lines.splitlines()]
        assert {place for place, _ in places} == {HOSTS[host], "127.0.0.1"}
        pages = [f"{at}:{port}" for at, port in places if at == "127.0.0.1"]
        for page in [f"{each}/{name}" for each in pages for name in ("status", "info/main/workers.html", "metrics", "")]:  # fmt: skip
            said = ["curl", "-s", "-o", "/dev/null", "-w", "%{http_code}", f"http://{page}"]
            done = subprocess.run(network[host].command(*said), capture_output=True, check=False)
            assert done.stdout == b"404", page
    assert key.stat().st_mode & 0o777 == 0o600
    key.unlink()
    assert f"key {key}: No such file" in _refused(client, tmp_path)
    words = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=x", "-out", key, "-keyout", key]  # fmt: skip
    subprocess.run(words, check=True, capture_output=True)
    key.chmod(0o600)
    assert f"no Dask scheduler at {ADDRESS}: " in _refused(client, tmp_path)


def _refused(client, folder):
    """Return what the client says, which does not check."""
    (folder / "class/ada").mkdir(parents=True, exist_ok=True)
    call = client(folder / "class")
    assert call.wait(60) == 2 and "Traceback" not in call.output
    return call.output


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_a_worker_leaves_no_folder(
    literal, tmp_path, scheduler, worker, client, monkeypatch, number
):
    """Though it is ended while it checks."""
    shutil.copytree(literal.parent, tmp_path / "class/ada")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    scheduler()
    monkeypatch.setenv("TMPDIR", str(temporary))
    one = worker("one", 1)
    monkeypatch.delenv("TMPDIR")
    client(tmp_path / "class")
    wait_for(lambda: examines(one), "an examination", 120)
    assert list(temporary.glob("tutorial_worker_*/tutorial_check_*"))
    os.kill(one.pid, number)
    wait_for(lambda: not list(temporary.iterdir()), "an empty folder", 120)
