"""The files of a package that a program in C++ is made of."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Callable

from tutorial_check.data.recordings import Executable
from tutorial_check.errors import CannotCheck
from tutorial_check.submission.cpp_tree import included, parsed

CPP_ENDINGS = (".cpp", ".cc", ".cxx", ".c++", ".C", ".CPP")
HEADER_ENDINGS = (".h", ".hpp", ".hh", ".hxx")
Read = Callable[[Path], str]  # raises CannotCheck, as for a file of more than 256 kB


def main_of(executable: Executable, sources: list[Path], read: Read) -> Path:
    """Return the source that is called as the program; else the first that seems to have main()."""
    named = [path for path in sources if path.stem == executable.name]
    with_main = (path for path in sources if "main(" in _text(path, read).replace(" ", ""))
    return named[0] if named else next(with_main, sources[0])


def texts_of(main: Path, sources: list[Path], folder: Path, read: Read) -> dict[str, str]:
    """Return {path within a package's folder: text} of a program's files, its main source first.

    They are its sources, and those headers of the package that they include, even indirectly. Other
    files than the main one that cannot be read, such as a large library's header, are left out.
    """
    headers = [path for path in sorted(folder.rglob("*")) if path.suffix in HEADER_ENDINGS]
    texts, waiting = {main: read(main)}, [main, *sources]
    while waiting:
        path = waiting.pop(0)
        text = texts.setdefault(path, _text(path, read))
        names = tuple(f"/{name.lstrip('./')}" for name in included(parsed(text)))
        waiting += [header for header in headers if str(header).endswith(names)]
        headers = [header for header in headers if header not in waiting]
    return {str(path.relative_to(folder)): text for path, text in texts.items() if text}


def _text(path: Path, read: Read) -> str:
    with contextlib.suppress(CannotCheck):
        return read(path)
    return ""
