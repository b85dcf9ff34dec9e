"""--watch: checks again when a file is saved, the first wrong check on top."""

import os
import threading
import time

from tutorial_check.examination import examine
from tutorial_check.model import WRONG, CannotCheck
from tutorial_check.report import Terminal, lines_of, summary

QUIET_S = 0.3  # editors save in several steps; it begins when they have finished
IGNORED = ("/build/", "/devel/", "/.git/", "__pycache__", ".swp", "~")


def matters(path, folder):
    """Whether a change of a file in a folder is one of the student's."""
    inside = f"/{os.path.relpath(path, folder)}/"
    return not any(word in inside for word in IGNORED)


class Changes:
    """Tells when a file of a folder has changed."""

    def __init__(self, folder):
        """Raises CannotCheck."""
        from watchdog.events import FileSystemEventHandler  # noqa: PLC0415  only here
        from watchdog.observers import Observer  # noqa: PLC0415

        if not os.path.isdir(folder):
            raise CannotCheck(f"{folder}: no folder, and --watch is for one")
        self._folder = folder
        self._changed = threading.Event()
        handler = FileSystemEventHandler()
        handler.on_any_event = self._on_event
        self._observer = Observer()
        try:
            self._observer.schedule(handler, str(folder), recursive=True)
            self._observer.start()
        except OSError as error:
            raise CannotCheck(
                f"{folder}: {error.strerror}; without --watch it is checked once"
            ) from None

    def _on_event(self, event):
        if event.event_type in ("opened", "closed_no_write"):
            return
        if not event.is_directory and matters(event.src_path, self._folder):
            self._changed.set()

    def wait(self):
        """Return once something has changed, and then nothing for a moment."""
        while not self._changed.wait(0.5):
            pass
        while self._changed.is_set():
            self._changed.clear()
            time.sleep(QUIET_S)

    def end(self):
        """Watch no longer."""
        self._observer.stop()


def watch(options, examine=examine):
    """Until Ctrl-C: examine, tell the first that is wrong, wait for a change."""
    changes = Changes(options.workspace)
    try:
        while True:
            print("\x1b[2J\x1b[H" if Terminal().is_terminal else "", end="")
            tell_once(options, examine)
            print(f"waiting for a change in {options.workspace} (Ctrl-C ends)", flush=True)
            changes.wait()
    finally:
        changes.end()


def tell_once(options, examine):
    """One round: exercise after exercise, up to the first thing wrong."""
    outcomes, terminal = [], Terminal()
    for exercise in options.exercises:
        terminal.busy(f"checking {exercise}")
        try:
            outcomes += examine(options.workspace, options.floor, [exercise], only_first=True)
        except CannotCheck as error:
            terminal.done()
            print(f"check: {error}")  # half-saved, or a folder that is just being moved
            return
        terminal.done()
        wrong = [result for result in outcomes[-1].results if result.status == WRONG]
        if wrong:
            print("\n".join(lines_of(wrong[0], not options.no_hints)))
            break
        if outcomes[-1].trouble:
            print(f"check: {exercise}: no verdict: {outcomes[-1].trouble}")
            break
    done = ", ".join(outcome.id for outcome in outcomes if outcome.passed)
    print(
        f"done: {done or 'none yet'}"
        if len(outcomes) < len(options.exercises) or not outcomes[-1].passed
        else summary(outcomes)
    )
