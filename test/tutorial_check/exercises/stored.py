"""Stored recordings of the rows, judged without running their programs again."""

import functools
import hashlib
import json
import lzma
import re
import shutil
from pathlib import Path

from recorder_code import REPOSITORY, code_hash

from tutorial_check.course.definition import read_course
from tutorial_check.data.json_data import as_json, from_json
from tutorial_check.examining.judging import judge
from tutorial_check.recording.launcher import prepared
from tutorial_check.submission.order import Order, Reply

FOLDER = Path(__file__).resolve().parent / "recordings"
NEW = FOLDER / "new"


def section_of(test):
    """Return the file with a row's recordings: its exercise's or its test's."""
    exercise = re.search(r"test_a_mistake_(?:in_(cpp)_)?is_found\[([\d.]+) ", test)
    name = "_".join(filter(None, exercise.groups())) if exercise else test.partition("[")[0][5:]
    return FOLDER / f"{name}.jsonl.xz"


@functools.lru_cache(maxsize=None)
def rows_of(section):
    """Return {test: stored data} of a section; each row is a line of the file."""
    text = lzma.decompress(section.read_bytes()).decode() if section.exists() else ""
    return {row.pop("row"): row for row in map(json.loads, text.splitlines())}


def names(workspace, underlay):
    """Return {folder on this machine: its word}."""
    lower = Path(underlay).parents[1]
    return {str(workspace): "{workspace}", str(lower): "{underlay}", str(REPOSITORY): "{suite}"}


def write(test, outcomes, workspace, underlay):
    """Keep recordings in a separate file until merge() collects those of all tests."""
    recordings = [recording for outcome in outcomes for recording in outcome.recordings]
    text = json.dumps({"row": test, "code": code_of(recordings), "recordings": recordings})
    assert not [path for path in names(workspace, underlay) if path in text], text
    NEW.mkdir(parents=True, exist_ok=True)
    _new(test).write_text(text)


def _new(test):
    return NEW / f"{hashlib.sha256(test.encode()).hexdigest()}.json"


def merge():
    """Move what write() has kept into the files of the sections."""
    new = {}
    for file in NEW.glob("*.json"):
        row = json.loads(file.read_text())
        name = row.pop("row")
        new.setdefault(section_of(name), {})[name] = row
    for section, rows in new.items():
        store(section, {**rows_of(section), **rows})
    shutil.rmtree(NEW, ignore_errors=True)


def store(section, rows):
    lines = (json.dumps({"row": name, **rows[name]}) for name in sorted(rows))
    section.parent.mkdir(exist_ok=True)
    section.write_bytes(lzma.compress("".join(f"{line}\n" for line in lines).encode(), preset=9))


def judged(test, workspace, underlay, exercises, folder, **about):
    """Return a workspace's Outcomes, judged from stored recordings; folder: empty, for a copy."""
    new = _new(test)
    row = json.loads(new.read_text()) if new.exists() else rows_of(section_of(test)).get(test)
    assert row, f"{test} is not stored: ./tutorial test exercises --store -k 'A and B'"
    replies = {}
    for recorded in row["recordings"]:
        question = [recorded["recorder"], recorded["arguments"]]
        replies.setdefault(json.dumps(question), []).append(_reply_of(recorded))

    def ask(question):
        turns = replies[json.dumps([question.recorder, as_json(question.arguments)])]
        return turns.pop(0) if len(turns) > 1 else turns[0]

    order = prepared(Order(workspace, underlay, exercises, **about), folder)
    return judge(order, read_course(), ask)


def _reply_of(recorded):
    """Return a worker's Reply from what is stored."""
    asked = ("recorder", "arguments")
    return from_json(Reply, {name: recorded[name] for name in recorded if name not in asked})


def code_of(recordings):
    """Return {module of recorders: hash of its code and of what it imports}."""
    modules = {recording["recorder"].partition(":")[0] for recording in recordings}
    return {name: code_hash(name) for name in sorted(modules)}
