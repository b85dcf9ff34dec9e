"""--cluster: checks on the workers of a Dask scheduler, each a ./tutorial worker on its machine.

What a student handed in is sent as an archive; a worker needs this suite, in the same version, and no
shared folder. Dask does the rest: distribution, TLS, and another try if a worker dies.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import logging
import os
import shutil
import socket
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence
from urllib.parse import urlsplit

from node_kit.arguments import Parser
from tutorial_check.course import OURS, read_course
from tutorial_check.examination import Outcome, examine
from tutorial_check.last_run import MOST_BYTES, digest_of_checks
from tutorial_check.model import CannotCheck
from tutorial_check.workspace import IGNORED

MOST_AT_ONCE = 1000  # submissions that the scheduler knows of
TRIES = 2  # a submission that ends so many workers is abandoned
PORT = 8786  # of a Dask scheduler
CONNECT_S = 10.0


class Gone(CannotCheck):
    """The scheduler is gone, and no other student can be checked."""


def _dask() -> Any:
    try:
        return importlib.import_module("distributed")
    except ImportError:
        raise CannotCheck("no Dask here; ./tutorial installs it with --cluster") from None


def _connect(address: str) -> str:
    """Return our address on the way to tcp://HOST:PORT, tls://HOST:PORT or HOST:PORT.

    Raises CannotCheck if nothing listens there.
    """
    try:
        place = urlsplit(address if "//" in address else f"//{address}")
        there = place.hostname or "", place.port or PORT
        with socket.create_connection(there, CONNECT_S) as connection:
            return str(connection.getsockname()[0])
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise CannotCheck(f"no Dask scheduler at {address}: {why}") from None


class Cluster:
    """A connection to a scheduler. Its methods may be called by many threads at once."""

    def __init__(self, address: str) -> None:
        """Connect. Raises CannotCheck."""
        self._dask, self._address = _dask(), address
        _connect(address)
        logging.disable(logging.CRITICAL)  # a lost connection is one line of ours, not Dask's many
        try:
            self._client = self._dask.Client(address, timeout=CONNECT_S, set_as_default=False)
            self._client.run_on_scheduler(_prepare)
        except Exception as error:  # also of a server that is no scheduler, or of a certificate
            raise CannotCheck(f"no Dask scheduler at {address}: {error or 'no answer'}") from None
        if not self._client.nthreads():
            print(f"no worker yet; on each machine: ./tutorial worker {address}", flush=True)

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Return what a function of this suite returns on a worker. Raises what it raises, or Gone."""
        try:
            future = self._client.submit(function, *arguments, pure=False)
            return future.result()
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
            why = f"the scheduler at {self._address} is gone; call again, and it goes on from here"
            raise Gone(why) from error

    def examine(
        self, workspace: Path, exercises: Sequence[str], course: Path, variant: Mapping[str, Any]
    ) -> list[Outcome]:
        """Return the Outcomes of a submission, as examination.examine does. Raises CannotCheck."""
        parts = {"submission": workspace, **({} if course == OURS else {"course": course})}
        version = digest_of_checks(read_course(course), exercises, 2)
        about = _packed(parts), exercises, dict(variant), version
        found: list[Outcome] = self.call(_examine, *about)
        return found

    def close(self) -> None:
        """Give up what was not checked yet."""
        self._client.close()


def _prepare(dask_scheduler: Any) -> None:
    """Give a worker one task at a time, so that only that task can have ended it."""
    dask_scheduler.allowed_failures = TRIES - 1
    dask_scheduler.WORKER_SATURATION = 1.0


_prepare.__module__ = "__main__"  # sent as it is: a scheduler need not have this suite


def _packed(parts: Mapping[str, Path]) -> bytes:
    """Return an archive of folders or files, without what catkin builds and what is no file."""
    data, left = io.BytesIO(), MOST_BYTES

    def kept(member: tarfile.TarInfo) -> tarfile.TarInfo | None:
        nonlocal left
        left -= member.size
        if left < 0:
            raise CannotCheck(f"more than {MOST_BYTES // 10**6} MB")
        is_kept = Path(member.name).name not in IGNORED
        return member if is_kept and (member.isfile() or member.isdir() or member.issym()) else None

    with tarfile.open(fileobj=data, mode="w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name, path in parts.items():
            archive.add(path, f"{name}{path.suffix if path.is_file() else ''}", filter=kept)
    return data.getvalue()


def _examine(
    packed: bytes, exercises: Sequence[str], variant: Mapping[str, Any], version: str
) -> list[Outcome]:
    """Check a submission on this machine. Raises CannotCheck."""
    underlay = os.environ["TUTORIAL_UNDERLAY"]
    with tempfile.TemporaryDirectory(prefix="tutorial_worker_") as folder:
        # The client packed it, and a worker runs whatever its client sends.
        with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
            archive.extractall(folder)
        (submission,) = Path(folder).glob("submission*")
        own = Path(folder, "course")
        course = own if own.is_dir() else OURS
        if digest_of_checks(read_course(course), exercises, 2) != version:
            raise CannotCheck(f"worker {socket.gethostname()} has another version of this suite")
        return examine(submission, underlay, exercises, own=False, course=course, variant=variant)


def work(address: str, jobs: int) -> None:
    """Make this process a worker; it does not return. Raises CannotCheck."""
    _dask()
    host = _connect(address)
    folder = tempfile.mkdtemp(prefix="tutorial_worker_")  # which Dask empties at its end
    words = [address, "--host", host, "--nworkers", jobs, "--nthreads", 1, "--memory-limit", 0]
    words += ["--no-dashboard", "--local-directory", folder, "--death-timeout", 60]
    python = shutil.which("python3", path="/usr/bin") or "python3"
    os.execv(python, [python, "-m", "distributed.cli.dask_worker", *map(str, words)])


def main() -> None:
    """./tutorial worker ADDRESS: work until Ctrl-C."""
    what = "Checks submissions for a Dask scheduler, which ./tutorial check --all FOLDER --cluster feeds."
    parser = Parser(prog="./tutorial worker", description=what)
    parser.add_argument("address", metavar="ADDRESS", help="of the scheduler, as tcp://HOST:8786")
    what = "submissions at a time (one for each two processors)"
    default = max(1, (os.cpu_count() or 1) // 2)
    parser.add_argument("--jobs", type=int, default=default, metavar="N", help=what)
    options = parser.parse_args()
    try:
        work(options.address, max(1, options.jobs))
    except CannotCheck as error:
        sys.exit(f"worker: {error}")


if __name__ == "__main__":
    main()
