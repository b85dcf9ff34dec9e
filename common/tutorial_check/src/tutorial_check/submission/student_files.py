"""Read and write a student's files, with a limit, and without following planted links."""

import contextlib
import os
import stat
from pathlib import Path
from typing import Iterator, Tuple

from tutorial_check.errors import CannotCheck, FileTooLarge

# A program, launch file or manifest of the exercises has about 2 kB. Diagnosing a file a hundred
# times as large would take too much time and memory.
MOST_BYTES = 256 << 10
TOO_LARGE = f"larger than {MOST_BYTES >> 10} kB"


def is_too_large(path: Path) -> bool:
    """Return whether a text file is larger than any written by hand."""
    return path.stat().st_size > MOST_BYTES


def text_of_file(path: Path) -> str:
    """Return the content of a text file. Raises FileTooLarge."""
    if is_too_large(path):
        raise FileTooLarge(path.name)
    return path.read_text(errors="replace")


def put_file(base: Path, path: Path, text: str, mode: int = 0o644) -> None:
    """Replace a file below a folder with a new one. Raises CannotCheck."""
    with _folder_of(base, path) as (folder, name):
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name, dir_fd=folder)
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW
        with open(os.open(name, flags, mode, dir_fd=folder), "w", encoding="utf-8") as file:
            os.fchmod(file.fileno(), mode)
            file.write(text)


def read(base: Path, path: Path) -> bytes:
    """Return the content of a file below a folder, but at most one byte more than MOST_BYTES.

    Raises CannotCheck, also for a pipe or a device.
    """
    with _folder_of(base, path) as (folder, name):
        flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK
        with open(os.open(name, flags, dir_fd=folder), "rb") as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError("no regular file")
            return file.read(MOST_BYTES + 1)


@contextlib.contextmanager
def _folder_of(base: Path, path: Path) -> Iterator[Tuple[int, str]]:
    """Yield (descriptor of a file's folder, its name)."""
    wanted = os.path.normpath(os.path.realpath(base) / path.parent.relative_to(base))
    try:
        if ".." in path.parts:  # a recording may be forged
            raise OSError("its path leads elsewhere")
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            if os.readlink(f"/proc/self/fd/{folder}") != wanted:
                raise OSError("its folder is a link")
            yield folder, path.name
        finally:
            os.close(folder)
    except OSError as error:
        why = error.strerror or error
        raise CannotCheck(f"a program changed {path}: {why}") from None
