"""Waiting for a device, a time or another thread; and for a file to appear."""

import fnmatch
import os
import select
import time

from watchdog.events import FileSystemEventHandler
from watchdog.observers import Observer


class Wake:
    """Waits until a file can be read, until a time, or until wake(), whichever comes first."""

    def __init__(self):
        """Use it in one thread; wake() may come from any."""
        self._read_end, self._write_end = os.pipe()
        for end in (self._read_end, self._write_end):
            os.set_blocking(end, False)

    def wake(self, *_):
        """End the wait, or the next one if nobody waits now."""
        try:
            os.write(self._write_end, b"!")
        except BlockingIOError:
            pass  # woken often enough

    def wait(self, until, *files):
        """Wait until a time of time.monotonic() [s] at the latest; returns the readable files."""
        # Not poll(), which counts in whole milliseconds.
        timeout = max(0.0, until - time.monotonic())
        readable, _, _ = select.select([self._read_end, *files], (), (), timeout)
        if self._read_end in readable:
            readable.remove(self._read_end)
            os.read(self._read_end, 4096)
        return readable


class AppearanceWatch(FileSystemEventHandler):
    """Calls back when a file that is looked for may have appeared or changed its permissions.

    By inotify, with the library watchdog: unlike udev it also works in a container, and for a FIFO.
    Without inotify (too many watches on this machine) nothing is called, so look from time to time.
    """

    def __init__(self, pattern, callback):
        """pattern: path of the file, in the way of fnmatch."""
        self._pattern = pattern
        self._callback = callback
        self._folder = self._observer = None

    def look(self):
        """Watch the folder of the file, or as long as that is missing, the nearest above it."""
        folder = os.path.dirname(self._pattern)
        while not os.path.isdir(folder):
            folder = os.path.dirname(folder)
        if folder == self._folder:
            return
        self.stop()
        self._folder, observer = folder, Observer()
        observer.schedule(self, folder, recursive=False)
        try:
            observer.start()
            self._observer = observer
        except OSError:
            pass

    def stop(self):
        """Stop watching."""
        if self._observer:
            self._observer.stop()
            self._observer.join()
        self._folder = self._observer = None

    def on_created(self, event):
        """Wake up, for watchdog."""
        self._appeared(event.src_path)

    def on_modified(self, event):
        """Wake up, for watchdog; a change of permissions counts as such."""
        if not event.is_directory:
            self._appeared(event.src_path)

    def on_moved(self, event):
        """Wake up, for watchdog."""
        self._appeared(event.dest_path)

    def _appeared(self, path):
        if fnmatch.fnmatchcase(path, self._pattern) or self._pattern.startswith(path + "/"):
            self._callback()
