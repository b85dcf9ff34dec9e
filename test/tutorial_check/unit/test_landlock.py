"""What a program reaches under each version of Landlock that this kernel can imitate."""

import errno
import os
import platform
from contextlib import suppress

import pytest

from tutorial_check.sandbox import landlock, privileges
from tutorial_testing.claims import claim

# Rights of each version; the first are in linux/landlock.h since Linux 5.13.
SYSTEM = ("/usr", "/lib", "/lib64", "/bin", "/proc")
RIGHTS = {1: 0x1FFF, 2: 0x3FFF, 3: 0x7FFF, 4: 0x7FFF, 5: 0xFFFF, 6: 0xFFFF, 7: 0xFFFF}


@pytest.mark.parametrize(("version", "rights"), RIGHTS.items())
def test_no_version_is_asked_for_rights_that_it_does_not_know(version, rights):
    assert landlock.rights_of(version) == rights


@claim("What the system does not provide is said first", because="Landlock")
def test_landlock_is_not_used_on_an_unknown_machine_or_kernel(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    assert landlock.version.__wrapped__() == 0
    monkeypatch.undo()
    monkeypatch.setattr(landlock, "CREATE_RULESET", -1)  # ENOSYS
    assert landlock.version.__wrapped__() == 0


def truncate_by_reading(path):
    os.close(os.open(path, os.O_RDONLY | os.O_TRUNC))


def move(own):
    os.rename(own / "here" / "file", own / "there" / "file")


def reached(version, attempts, shown, own, monkeypatch):
    """Return the names of the attempts that succeed in a confined process."""
    monkeypatch.setattr(landlock, "version", lambda: version)
    begin, end = os.pipe()
    child = os.fork()
    if child == 0:
        with suppress(BaseException):
            privileges.give_up_rights()
            landlock.confine(landlock.ruleset([shown, *SYSTEM], [own]))
            for name, attempt in attempts.items():
                try:
                    attempt()
                except OSError as error:
                    if error.errno not in (errno.EACCES, errno.EPERM, errno.EXDEV):
                        os.write(end, f"{name}: {error}\n".encode())
                else:
                    os.write(end, f"{name}\n".encode())
        os._exit(0)
    os.close(end)
    with open(begin, encoding="utf-8") as lines:
        names = set(lines.read().splitlines())
    os.waitpid(child, 0)
    return names


@claim("A hostile program ...", because="every version of Landlock")
@pytest.mark.parametrize("version", RIGHTS)
def test_files_of_others_stay_as_they_are_under_each_version(version, tmp_path, monkeypatch):
    if landlock.version() < version:
        pytest.skip(f"this kernel has version {landlock.version()} of Landlock")
    shown, own, other = (tmp_path / name for name in ("shown", "own", "other"))
    for folder in (shown, own / "here", own / "there", other):
        folder.mkdir(parents=True)
        (folder / "file").write_text("text")
    attempts = {
        "reads what is shown": (shown / "file").read_text,
        "writes its own": lambda: (own / "new").write_text("x"),
        "adds to its own": lambda: open(own / "new", "a").close(),
        "empties its own": lambda: open(own / "new", "w").close(),
        "uses a device": lambda: open("/dev/null", "w").close(),
        "renames": lambda: (own / "new").rename(own / "newer"),
        "moves": lambda: move(own),
        "reads others'": (other / "file").read_text,
        "writes others'": lambda: (other / "file").write_text("x"),
        "truncates others'": lambda: os.truncate(other / "file", 0),
        "truncates what is shown": lambda: os.truncate(shown / "file", 0),
        "truncates by reading": lambda: truncate_by_reading(shown / "file"),
        "removes others'": (other / "file").unlink,
        "links others'": lambda: os.link(other / "file", own / "link"),
    }
    granted = [*attempts][: 7 if version >= 2 else 6]  # version 1 moves nothing to another folder
    assert reached(version, attempts, shown, own, monkeypatch) == set(granted)
    assert [(folder / "file").read_text() for folder in (shown, other)] == ["text"] * 2
