"""The recordings that pages have opened: each is read once, and all together are bounded."""

from collections import OrderedDict
from pathlib import Path

import rospkg

from cockpit_server.clients import encoded
from cockpit_server.recording import MOST_MESSAGES, RecordingError, curves, read

MOST_NAMES = 100
MOST_KEPT = 20  # recordings


def recordings(may_drive):
    """Return {name: path} of the suite's recording and, for drivers, those of this folder."""
    ours = Path(rospkg.RosPack().get_path("gamepad")) / "bag" / "joy.bag"
    here = sorted(filter(Path.is_file, Path.cwd().glob("*.bag"))) if may_drive else []
    return {path.name: path for path in [ours, *here[:MOST_NAMES]]}


class Shelf:
    """The recordings that were read. Used by one thread, except in_use."""

    def __init__(self):
        self._read = OrderedDict()  # what the file is -> (Recording, message of it to pages)
        self.in_use = ()  # Recordings that pages have open; set anew, never changed

    def take(self, path):
        """Return (Recording, message) of a file. Raises RecordingError."""
        try:
            about = path.stat()
        except OSError as error:
            raise RecordingError(f"{path.name}: cannot be read: {error.strerror}") from None
        key = (path, about.st_mtime_ns, about.st_size)
        if key not in self._read:
            self._read[key] = self._taken(path)
        self._read.move_to_end(key)
        self._make_room(self._read[key][0])
        return self._read[key]

    def _taken(self, path):
        recording = read(path)
        topics = [
            {"name": topic, "type": kind, "count": count}
            for topic, (kind, count) in sorted(recording.topics.items())
        ]
        # Before anything changes: what cannot be shown is not opened.
        return recording, encoded(
            "bag", path=path.name, start=recording.start, end=recording.end, topics=topics,
            curves=curves(recording.joys),
        )  # fmt: skip

    def _make_room(self, newest):
        used = {id(one) for one in (*self.in_use, newest)}
        unused = [key for key, (one, _) in self._read.items() if id(one) not in used]
        while unused and (len(self._read) > MOST_KEPT or self._has_too_many()):
            del self._read[unused.pop(0)]
        if self._has_too_many() and len(self._read) > 1:
            self._read.popitem()
            raise RecordingError("other pages have long recordings open: close one of them")

    def _has_too_many(self):
        return sum(one.messages for one, _ in self._read.values()) > MOST_MESSAGES
