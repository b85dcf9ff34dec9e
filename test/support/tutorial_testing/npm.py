"""Programs of npm that tests use and Debian lacks, from test/locks/npm; its nodejs has no npm."""

import base64
import contextlib
import hashlib
import io
import json
import os
import tarfile
import tempfile
import urllib.request
from pathlib import Path

LOCKS = Path(__file__).resolve().parents[2] / "locks"
REGISTRY = "https://registry.npmjs.org"
TIMEOUT_S = 60


def modules(lock: str = "npm") -> Path:
    """Return the folder node_modules with the locked packages; fetch them the first time."""
    text = (LOCKS / lock / "package-lock.json").read_bytes()
    results = Path(os.environ["TUTORIAL_RESULTS"])
    folder = results / f"npm-{hashlib.sha256(text).hexdigest()[:16]}"
    if not folder.exists():
        results.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=results) as place:
            for path, package in json.loads(text)["packages"].items():
                if path:  # "" is the list itself
                    _fetch(package, Path(place, "packages", path))
            with contextlib.suppress(OSError):  # another test has fetched them meanwhile
                os.rename(f"{place}/packages", folder)
    return folder / "node_modules"


def _fetch(package: dict, folder: Path) -> None:
    name = str(folder).rpartition("node_modules/")[2]
    url = f"{REGISTRY}/{name}/-/{Path(name).name}-{package['version']}.tgz"
    with urllib.request.urlopen(url, timeout=TIMEOUT_S) as answer:
        data = answer.read()
    algorithm, _, digest = package["integrity"].partition("-")
    if hashlib.new(algorithm, data).digest() != base64.b64decode(digest):
        raise ValueError(f"{url} is not what it was")
    folder.mkdir(parents=True)
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        for member in archive.getmembers():
            member.name = member.name.partition("/")[2]  # without the archive's own folder
            archive.extract(member, folder)
