"""Recordings, opened so that each mistake in the file is one line."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

import rosbag


class BagError(ValueError):
    """Why a bag cannot be read, in one line for the user that begins with its path."""


@contextmanager
def opened(path: str | Path) -> Iterator[rosbag.Bag]:
    """Open a bag. Raises BagError, also for what is wrong while it is read."""
    try:
        if Path(path).is_fifo() or Path(path).is_char_device():  # nothing may ever come from them
            raise BagError(f"{path}: not a plain file")
        with rosbag.Bag(str(path)) as bag:
            yield bag
    except BagError:
        raise
    except OSError as error:
        raise BagError(f"{path}: cannot be read: {error.strerror or error}") from None
    except rosbag.ROSBagUnindexedException:
        raise BagError(f"{path}: cut short; fix it with: rosbag reindex {path}") from None
    except Exception as error:  # rosbag lets struct.error and more through from a damaged file
        why = " ".join(str(error).split()) or type(error).__name__
        raise BagError(f"{path}: not a bag that can be read: {why:.200}") from None
