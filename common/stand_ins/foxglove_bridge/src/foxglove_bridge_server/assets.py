"""Files of packages, such as the meshes of a robot's model."""

from __future__ import annotations

from pathlib import Path
from typing import Callable, Iterable, Pattern
from urllib.parse import unquote

from foxglove_bridge_server.parameters import is_allowed

LONGEST = 50_000_000  # bytes
_SCHEME = "package://"


def read_asset(
    uri: str, allowed: Iterable[Pattern[str]], folder_of: Callable[[str], str]
) -> bytes | None:
    """Return the bytes of package://PACKAGE/FILE, if allowed; None otherwise.

    folder_of: returns the folder of a package. What it raises is raised, and OSError.
    """
    if not uri.startswith(_SCHEME) or ".." in unquote(uri) or not is_allowed(uri, allowed):
        return None
    package, _, name = unquote(uri[len(_SCHEME) :]).partition("/")
    path = Path(folder_of(package), name)
    return path.read_bytes() if path.is_file() and path.stat().st_size <= LONGEST else None
