"""--cluster: check on the workers of a Dask scheduler, each a ./tutorial worker on its machine.

A submission is sent as an archive. A worker needs the same version of this suite, but no shared
folder. Dask does the rest: distribution, TLS, and another try if a worker exits.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import logging
import os
import shutil
import socket
import subprocess
import tarfile
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any, Mapping, NoReturn
from urllib.parse import urlsplit

from tutorial_check.checking.results import Outcome
from tutorial_check.course.definition import read_course
from tutorial_check.errors import CannotCheck, SchedulerGone
from tutorial_check.examining.examination import examine
from tutorial_check.report.memory import digest_of_checks
from tutorial_check.sandbox import bubblewrap, landlock, privileges
from tutorial_check.submission.handed_in import MOST_BYTES
from tutorial_check.submission.order import Order
from tutorial_check.submission.packages import IGNORED

MOST_AT_ONCE = 1000  # submissions that the scheduler holds
TRIES = 2  # a submission that ends this many workers is abandoned
PORT = 8786  # Dask scheduler
CONNECT_S = 10.0
# Anyone with this file can connect: it is the certificate, authority and private key of all.
CONFIG = os.environ.get("XDG_CONFIG_HOME") or "~/.config"
KEY = Path(CONFIG, "ros1_tutorial/cluster.pem").expanduser()
OPENSSL = """openssl req -x509 -newkey rsa:3072 -nodes -days 3650 -subj /CN=ros1_tutorial
-addext keyUsage=critical,keyCertSign,digitalSignature,keyEncipherment"""
# Even without a dashboard Dask serves pages about itself, unless it has no routes.
NO_PAGES = {
    f"DASK_DISTRIBUTED__{program}__HTTP__ROUTES": "[]" for program in ("SCHEDULER", "WORKER")
}
LOCAL = ("--no-dashboard", "--dashboard-address", "127.0.0.1:0")
INSISTS = "TUTORIAL_NOT_ISOLATED"  # environment variable of a worker with --not-isolated


def _dask() -> Any:
    try:
        return importlib.import_module("distributed")
    except ImportError:
        raise CannotCheck("no Dask here; ./tutorial installs it with --cluster") from None


def _key_of(address: str) -> str:
    """Return the key file, made readable by this user only; "" without TLS. Raises CannotCheck."""
    if not address.startswith("tls://"):
        return ""
    try:
        KEY.chmod(0o600)
    except OSError as error:
        why = f"{error.strerror}; copy it from the machine of ./tutorial scheduler"
        raise CannotCheck(f"key {KEY}: {why}") from None
    return str(KEY)


def _connect(address: str) -> str:
    """Return our address towards a scheduler. Raises CannotCheck if nothing listens there."""
    try:
        place = urlsplit(address if "//" in address else f"//{address}")
        there = place.hostname or "", place.port or PORT
        with socket.create_connection(there, CONNECT_S) as connection:
            return str(connection.getsockname()[0])
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise CannotCheck(f"no Dask scheduler at {address}: {why}") from None


class Cluster:
    """A connection to a scheduler, which many threads may use at once."""

    def __init__(self, address: str) -> None:
        """Connect. Raises CannotCheck."""
        self._dask, self._address = _dask(), address
        key = _key_of(address)
        names = [f"tls_{name}" for name in ("ca_file", "client_cert", "client_key") if key]
        keys = self._dask.Security(**dict.fromkeys(names, key), require_encryption=bool(key))
        _connect(address)
        logging.disable(logging.CRITICAL)  # report a lost connection in one line of ours
        try:
            self._client = self._dask.Client(
                address, timeout=CONNECT_S, set_as_default=False, security=keys
            )
            self._client.run_on_scheduler(_prepare)
        except Exception as error:  # also if the server is no scheduler, or for a certificate
            raise CannotCheck(f"no Dask scheduler at {address}: {error or 'no answer'}") from None
        if not self._client.nthreads():
            print(f"no worker yet; on each machine: ./tutorial worker {address}", flush=True)

    def examine(self, order: Order) -> list[Outcome]:
        """Return the Outcomes of a submission. Raises CannotCheck, or SchedulerGone."""
        version = _version(order, order.course)
        parts = {"submission": order.workspace, f"course/{order.course.name}": order.course}
        about = _packed(parts), order, version
        try:
            return self._client.submit(_examine, *about, pure=False).result()
        except self._dask.KilledWorker:
            why = f"abandoned: {TRIES} workers have ended while they checked it"
            raise CannotCheck(why) from None
        except CannotCheck:
            raise
        except BaseException as error:
            with contextlib.suppress(CannotCheck):
                _connect(self._address)
                if self._client.status == "running":
                    raise
            why = f"the scheduler at {self._address} has ended; run the command again to continue"
            raise SchedulerGone(why) from error

    def close(self) -> None:
        """Cancel what has not been checked yet."""
        self._client.close()


def _prepare(dask_scheduler: Any) -> None:
    """Give a worker one task at a time, so that this task is to blame if the worker exits."""
    dask_scheduler.allowed_failures = TRIES - 1
    dask_scheduler.WORKER_SATURATION = 1.0


_prepare.__module__ = "__main__"  # sent by value: a scheduler need not have this suite


def _packed(parts: Mapping[str, Path]) -> bytes:
    """Return an archive of folders or files, without catkin's build folders and special files."""
    data, left = io.BytesIO(), MOST_BYTES

    def kept(member: tarfile.TarInfo) -> tarfile.TarInfo | None:
        nonlocal left
        left -= member.size
        if left < 0:
            raise CannotCheck(f"more than {MOST_BYTES >> 20} MB")
        archive.inodes.clear()  # type: ignore[attr-defined]  # a hard link is a file as any other
        is_kept = not (member.isdir() and Path(member.name).name in IGNORED)
        return member if is_kept and (member.isfile() or member.isdir() or member.issym()) else None

    with tarfile.open(fileobj=data, mode="w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name, path in parts.items():
            archive.add(path, f"{name}{path.suffix if path.is_file() else ''}", filter=kept)
    return data.getvalue()


def _version(order: Order, course: Path) -> str:
    return digest_of_checks(read_course(course), order.exercises, 2)


def _examine(packed: bytes, order: Order, version: str) -> list[Outcome]:
    _must_isolate()
    with tempfile.TemporaryDirectory(prefix="tutorial_worker_") as folder:
        with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
            # Python 3.14 refuses links that lead out; a worker runs any program anyway.
            archive.extraction_filter = lambda member, _: member
            archive.extractall(folder)
        (submission,) = Path(folder).glob("submission*")
        (course,) = Path(folder, "course").iterdir()
        underlay = os.environ["TUTORIAL_UNDERLAY"]
        if _version(order, course) != version:
            raise CannotCheck(f"worker {socket.gethostname()} has another version of this suite")
        return examine(replace(order, workspace=submission, course=course, underlay=underlay))


def _must_isolate() -> None:
    """Raise CannotCheck if a student's program could reach the scheduler, unless allowed."""
    if bubblewrap.instead() and INSISTS not in os.environ:
        why = f"{bubblewrap.granted().why}: a student's program could reach the scheduler"
        todo = "fix that, or ./tutorial worker --not-isolated"
        raise CannotCheck(f"worker {socket.gethostname()} cannot isolate programs: {why}; {todo}")


def become_worker(address: str, jobs: int, insists: bool) -> NoReturn:
    """Become a worker. insists: even if programs are not isolated. Raises CannotCheck."""
    if insists and bubblewrap.instead():
        if not address.startswith("tls://") or (os.geteuid() and not landlock.version()):
            why = "else a student's program reaches the scheduler, or reads the key"
            raise CannotCheck(f"--not-isolated needs tls://, and root or Linux 6.2: {why}")
        os.environ[INSISTS] = "1"
    _must_isolate()
    host = _connect(address)
    folder, cleaner = privileges.folder_until_end("tutorial_worker_")
    os.chmod(folder, 0o711)  # another user's programs pass through
    assert cleaner.stdin
    os.set_inheritable(cleaner.stdin.fileno(), True)
    os.environ["TMPDIR"] = folder
    words = ["--host", host, "--nworkers", jobs, "--nthreads", 1, "--memory-limit", 0]
    words += ["--local-directory", folder, "--death-timeout", 60]
    _become("worker", address, address, *words)


def become_scheduler(host: str) -> NoReturn:
    """Become a scheduler; make a key if there is none. Raises CannotCheck."""
    if not KEY.exists():
        KEY.parent.mkdir(parents=True, exist_ok=True)
        os.umask(0o077)
        words = [*OPENSSL.split(), "-keyout", str(KEY), "-out", str(KEY)]
        subprocess.run(words, check=True, stderr=subprocess.DEVNULL)
    print(f"workers and check --cluster: tls://{host}:{PORT}, with a copy of {KEY}", flush=True)
    _become("scheduler", "tls://", "--host", f"tls://{host}", "--port", PORT)


def _become(program: str, address: str, *words: object) -> NoReturn:
    _dask()
    key = _key_of(address)
    keys = [f"--tls-{name}={key}" for name in ("ca-file", "cert", "key") if key]
    os.environ.update(NO_PAGES)
    python = shutil.which("python3", path="/usr/bin") or "python3"
    module = f"distributed.cli.dask_{program}"
    os.execv(python, [python, "-m", module, *map(str, words), *keys, *LOCAL])
