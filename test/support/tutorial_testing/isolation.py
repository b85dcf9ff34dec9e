"""Older isolation tools, imitated on this system."""

from pathlib import Path

OLD_BUBBLEWRAP = """#!/bin/bash
for word; do
    case $word in
    --perms | --size | --disable-userns) echo "bwrap: Unknown option $word" >&2; exit 1 ;;
    --) break ;;
    esac
done
exec /usr/bin/bwrap "$@"
"""


def old_bubblewrap(folder: Path) -> str:
    """Return a folder for PATH with a bwrap that has the options of bubblewrap 0.4."""
    place = folder / "bwrap_0.4"
    place.mkdir()
    (place / "bwrap").write_text(OLD_BUBBLEWRAP)
    (place / "bwrap").chmod(0o755)
    return str(place)
