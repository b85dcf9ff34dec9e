"""--cluster: the results of one machine, whatever exits meanwhile; each worker has its host."""

import contextlib
import importlib.util
import json
import os
import shutil
import signal
import subprocess

import pytest
from edits import apply, at_night, put
from solution import TALKER
from test_awkward import PYTHONPATH, command, examines
from test_endings import path_without_namespaces
from test_mistakes import OF_HANDOUT

from tutorial_check.examining.examination import examine
from tutorial_check.submission.order import Order
from tutorial_testing.claims import claim
from tutorial_testing.processes import Program, command_line, descendants, signal_all
from tutorial_testing.two_hosts.network import Network
from tutorial_testing.waiting import wait_for

HAS_DASK = importlib.util.find_spec("distributed") is not None
pytestmark = [
    pytest.mark.skipif(not HAS_DASK, reason="no Dask here: ./tutorial check --cluster installs it"),
    pytest.mark.skipif(os.geteuid() != 0, reason="not root: no hosts of a network of their own"),
]
HOSTS = {"teacher": "10.66.0.1", "one": "10.66.0.2", "two": "10.66.0.3", "three": "10.66.0.4"}
ADDRESS = f"tls://{HOSTS['teacher']}:8786"
WORKER, SCHEDULER = (
    ("/usr/bin/python3", "-m", f"tutorial_check.commands.{word}")
    for word in ("worker", "scheduler")
)
EXERCISE = "3"
RACE = "Twist for String"  # the first of its two programs decides what is wrong
ROWS = [row for row in OF_HANDOUT if row.exercise == EXERCISE and row.what != RACE]
SUBMISSIONS, LONGEST_S = 8, 1800.0
GONE = f"check: no verdict: the scheduler at {ADDRESS} has ended; run the command again to continue"


@pytest.fixture
def start():
    with Network(HOSTS) as network, contextlib.ExitStack() as running:

        def begin(host, *words):
            words = network[host].command(*map(str, words))
            return running.enter_context(Program(*words, PYTHONPATH=PYTHONPATH))

        yield begin


@pytest.fixture(autouse=True)
def key(tmp_path, monkeypatch):
    """The key of a separate cluster, which students' programs cannot reach."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return tmp_path / "config/ros1_tutorial/cluster.pem"


@pytest.fixture
def scheduler(start):
    def begin():
        program = start("teacher", *SCHEDULER, "--host", HOSTS["teacher"])
        wait_for(lambda: "Scheduler at" in program.output, "a scheduler", 60)
        return program

    return begin


@pytest.fixture
def worker(start, underlay, monkeypatch):
    monkeypatch.setenv("TUTORIAL_UNDERLAY", underlay)
    return lambda host, *more: start(host, *WORKER, ADDRESS, *more)


@pytest.fixture
def folder(literal, tmp_path):
    shutil.copytree(literal.parent, tmp_path / "class" / "ada")
    return tmp_path / "class"


@pytest.fixture
def client(start, underlay, folder):
    words = command(underlay, "--all", folder, EXERCISE, "--cluster", ADDRESS)
    return lambda: start("teacher", *words)


def kill(program):
    """Kill all at once, as if memory were short, except what removes folders."""
    pids = [pid for pid in descendants(program.pid) if "rm -rf" not in command_line(pid)]
    signal_all(pids, signal.SIGKILL)


def hand_in(literal, folder, count):
    """Add students, with the mistakes of all rows in turn, and links such as students have."""
    rows = ROWS[:: max(1, len(ROWS) // count)]
    for number in range(count):
        student = folder / f"student_{number:04}"
        shutil.copytree(literal.parent, student)
        apply(rows[number % len(rows)].edits, student / "src")
        os.link(student / "src" / "beginner_tutorials" / "package.xml", student / "a_second_name")
        (student / "gone").symlink_to("../../gone")
        os.mkfifo(student / "pipe")


def checked(folder):
    return list((folder / "check").glob("[!.]*.json"))


def verdicts(results):
    """Return what must be the same: all but times and other measured numbers."""
    return [(result["id"], result["status"], result["title"]) for result in results]


@claim(
    "Whichever of worker, scheduler and call ends, nothing is lost; what ends two workers is "
    "abandoned"
)
@pytest.mark.night
@pytest.mark.parametrize("ended", ["worker", "scheduler", "client"])
def test_whatever_ends_nothing_is_lost(literal, folder, scheduler, worker, client, ended):
    """A worker that joins takes over; otherwise the same call continues where it stopped."""
    hand_in(literal, folder, SUBMISSIONS)
    running = {"scheduler": scheduler(), "worker": worker("one"), "client": client()}
    worker("two", "--jobs", 4)
    wait_for(lambda: checked(folder), "a first report", LONGEST_S)
    kill(running[ended])
    call, done = running["client"], 0
    if ended == "scheduler":
        assert call.wait(120) == 2, call.output
        assert GONE in call.output.splitlines()
        scheduler()
    worker("three")
    if ended != "worker":
        done = len(checked(folder)) - 1  # the last may be half written
        call = client()
    assert call.wait(LONGEST_S) in (1, 2), call.output  # 2: the machine was too busy for a verdict
    assert call.output.count("unchanged since the last check") >= done
    assert len(checked(folder)) == SUBMISSIONS + 1 and "Traceback" not in call.output


@claim("Results are those of one machine")
def test_results_are_those_of_one_machine(literal, folder, underlay, scheduler, worker, client):
    hand_in(literal, folder, 4)
    scheduler()
    worker("one", "--jobs", 4)
    call = client()
    assert call.wait(LONGEST_S) == 1, call.output
    for report in checked(folder):
        order = Order(folder / report.stem, underlay, [EXERCISE], is_callers_own=False)
        (outcome,) = examine(order)
        checks = json.loads(report.read_text())["exercises"][0]["checks"]
        assert verdicts(checks) == verdicts(map(vars, outcome.results)), report.stem


@claim("Whichever of worker, scheduler ...", because="what ends two workers")
@pytest.mark.night
def test_a_submission_that_ends_workers_is_abandoned(scheduler, worker, client):
    """Each worker is killed once it checks it, as by the kernel when memory is short."""
    scheduler()
    call = client()
    for host in ("one", "two"):
        program = worker(host, "--jobs", 1)  # with several, another could take it first
        wait_for(lambda program=program: examines(program), "a worker", 120)
        kill(program)
    assert call.wait(120) == 2, call.output
    assert "abandoned: 2 workers have ended while they checked it" in call.output


# A student's program that reads the key and runs code at the scheduler.
ATTACK = """
try:
    from distributed import Client
    from distributed.security import Security
    key = dict.fromkeys(("tls_ca_file", "tls_client_cert", "tls_client_key"), {key!r})
    client = Client({address!r}, timeout=5, security=Security(**key, require_encryption=True))
    client.run_on_scheduler(lambda path: open(path, "w").close(), {owned!r})
except BaseException as error:
    print(repr(error))
"""


@claim(
    "A student's program does not reach the scheduler; a worker that cannot isolate refuses to "
    "start"
)
@pytest.mark.parametrize("more", [(), *at_night(("--not-isolated",))])
def test_a_students_program_does_not_reach_the_scheduler(
    tmp_path, folder, scheduler, worker, client, key, monkeypatch, more
):
    """Each result of a worker with --not-isolated says so."""
    owned = tmp_path / "owned"
    attack = ATTACK.format(key=str(key), address=ADDRESS, owned=str(owned))
    put(TALKER, "import rospy\n", f"import rospy\n{attack}", 1)(folder / "ada" / "src")
    scheduler()
    with monkeypatch.context() as patched:
        if more:
            patched.setenv("PATH", path_without_namespaces(tmp_path))
        worker("one", "--jobs", 1, *more)
    call = client()
    assert call.wait(300) in (0, 1), call.output
    assert not owned.exists()
    report = (folder / "check/ada.txt").read_text()
    assert ("isolated by Landlock alone" in report or "not isolated" in report) == bool(more)


@claim("Who has no key is not let in, nothing listens elsewhere, pages are empty")
def test_who_has_no_key_is_not_let_in_nor_is_a_worker_without_a_scheduler(
    scheduler, client, start, key
):
    scheduler()
    assert key.stat().st_mode & 0o777 == 0o600
    key.unlink()
    call = client()
    assert call.wait(60) == 2 and f"key {key}: No such file" in call.output
    words = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=x"]
    subprocess.run([*words, "-out", key, "-keyout", key], check=True, capture_output=True)
    key.chmod(0o600)
    call = client()
    assert call.wait(60) == 2
    assert f"check: no verdict: no Dask scheduler at {ADDRESS}: " in call.output
    call = start("one", *WORKER, "127.0.0.1:1")
    assert call.wait(60) == 1
    assert call.output == "worker: no Dask scheduler at 127.0.0.1:1: Connection refused\n"


@claim("Who has no key ...", because="nothing listens, and pages are empty")
@pytest.mark.parametrize("host", ["teacher", *at_night("one")])
def test_nothing_listens_elsewhere_and_pages_are_empty(scheduler, worker, start, host):
    scheduler()
    programs = [worker("one", "--jobs", 1), worker("two", "--jobs", 1)]
    wait_for(lambda: all("Registered to" in program.output for program in programs), "workers", 60)
    listening = start(host, "ss", "-Hltn")
    assert listening.wait(60) == 0
    places = [line.split()[3].rsplit(":", 1) for line in listening.output.splitlines()]
    assert {place for place, _ in places} == {HOSTS[host], "127.0.0.1"}
    for port in (port for at, port in places if at == "127.0.0.1"):
        for page in ("status", "info/main/workers.html", "metrics", ""):
            url = f"http://127.0.0.1:{port}/{page}"
            call = start(host, "curl", "-s", "-o", "/dev/null", "-w", "%{http_code}", url)
            assert call.wait(60) == 0 and call.output == "404", url


@pytest.mark.parametrize("number", [signal.SIGTERM, *at_night(signal.SIGKILL)])
def test_a_worker_that_is_ended_while_it_checks_leaves_no_folder(
    tmp_path, scheduler, worker, client, monkeypatch, number
):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    scheduler()
    monkeypatch.setenv("TMPDIR", str(temporary))
    program = worker("one")
    monkeypatch.delenv("TMPDIR")
    client()
    wait_for(lambda: examines(program), "a worker", 120)
    assert list(temporary.glob("tutorial_worker_*/tutorial_check_*"))
    os.kill(program.pid, number)
    wait_for(lambda: not list(temporary.iterdir()), "an empty folder", 120)
