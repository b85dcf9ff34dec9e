"""Fetches the library of the cockpit's charts from npm's registry if Debian's archive lacks it."""

from __future__ import annotations

import hashlib
import io
import tarfile
import urllib.request
from pathlib import Path

from tutorial_tools.io.system.apt import say

OF_DEBIAN = Path("/usr/share/javascript/dygraphs")
FETCHED = "charts"  # folder in the workspace
URL = "https://registry.npmjs.org/dygraphs/-/dygraphs-2.2.1.tgz"  # the release of Debian 12 and 13
SHA256 = "f515549becffeb0912b0dffa963f7d42726818ca7ef5605bdd7707995742b7ec"
FILES = ("dygraph.min.js", "dygraph.css")
TIMEOUT_S = 30.0


def fetch_charts(workspace: Path, again: bool) -> None:
    """Fetch what the page's charts need, unless it is there; report a failure once.

    again: try again after a failure.
    """
    folder, failed = workspace / FETCHED, workspace / "no_charts"
    is_there = OF_DEBIAN.exists() or all((folder / name).exists() for name in FILES)
    if is_there or (failed.exists() and not again):
        return
    say(f"fetching the library of the cockpit's charts, which the archive lacks: {URL}")
    try:
        with urllib.request.urlopen(URL, timeout=TIMEOUT_S) as answer:
            data = answer.read()
        if hashlib.sha256(data).hexdigest() != SHA256:
            raise OSError("its checksum is wrong")
        with tarfile.open(fileobj=io.BytesIO(data)) as archive:
            contents = {name: archive.extractfile(f"package/dist/{name}") for name in FILES}
            texts = {name: file.read() for name, file in contents.items() if file}
    except (OSError, tarfile.TarError, KeyError) as error:
        workspace.mkdir(parents=True, exist_ok=True)
        failed.touch()
        say(f"not fetched: {error}. Check the network, then run ./tutorial setup again")
        say("everything except the cockpit's curves works without it")
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / name).write_bytes(text)
    failed.unlink(missing_ok=True)
