"""Recordings of the rows, stored: what their programs did is judged without running them again."""

import functools
import hashlib
import json
import lzma
import re
import shutil
from pathlib import Path

from recorder_code import REPOSITORY, code_hash

from tutorial_check.checking.judging import judge
from tutorial_check.course.definition import read_course
from tutorial_check.recording.data import as_json, from_json
from tutorial_check.recording.launcher import prepared
from tutorial_check.submission.order import Order, Reply

FOLDER = Path(__file__).resolve().parent / "recordings"
NEW = FOLDER / "new"


def section_of(test):
    """Return the file that a row's recordings are in: that of its exercise, or of its test."""
    exercise = re.search(r"test_a_mistake_is_found\[([\d.]+) ", test)
    return FOLDER / f"{exercise[1] if exercise else test.partition('[')[0][5:]}.jsonl.xz"


@functools.lru_cache(maxsize=None)
def rows_of(section):
    """Return {test: what is stored of it} of a section, in which each row is a line."""
    text = lzma.decompress(section.read_bytes()).decode() if section.exists() else ""
    return {row.pop("row"): row for row in map(json.loads, text.splitlines())}


def names(workspace, underlay):
    """Return {folder of this machine: a word for it}."""
    lower = Path(underlay).parents[1]
    return {str(workspace): "{workspace}", str(lower): "{underlay}", str(REPOSITORY): "{suite}"}


def write(test, outcomes, workspace, underlay):
    """Keep what was recorded in a file of its own, until merge() has those of all tests."""
    recordings = [recording for outcome in outcomes for recording in outcome.recordings]
    text = json.dumps({"row": test, "code": code_of(recordings), "recordings": recordings})
    assert not [path for path in names(workspace, underlay) if path in text], text
    NEW.mkdir(parents=True, exist_ok=True)
    name = hashlib.sha256(test.encode()).hexdigest()
    (NEW / f"{name}.json").write_text(text)


def merge():
    """Put what write() has kept into the files of the sections."""
    new = [json.loads(file.read_text()) for file in NEW.glob("*.json")]
    for section in {section_of(row["row"]) for row in new}:
        rows = {
            **rows_of(section),
            **{r.pop("row"): r for r in new if section_of(r["row"]) == section},
        }
        store(section, rows)
    shutil.rmtree(NEW, ignore_errors=True)


def store(section, rows):
    lines = (json.dumps({"row": name, **rows[name]}) for name in sorted(rows))
    section.parent.mkdir(exist_ok=True)
    section.write_bytes(lzma.compress("".join(f"{line}\n" for line in lines).encode(), preset=9))


def judged(test, workspace, underlay, exercises, folder, **about):
    """Return the Outcomes of a workspace, judged from what is stored. folder: empty, for a copy."""
    row = rows_of(section_of(test)).get(test)
    assert row, f"{test} is not stored: ./tutorial test exercises --store -k 'A and B'"
    replies = {}
    for recorded in map(of_today, row["recordings"]):
        question = [recorded.pop("recorder"), recorded.pop("arguments")]
        replies.setdefault(json.dumps(question), []).append(from_json(Reply, recorded))

    def ask(question):
        turns = replies[json.dumps([question.recorder, as_json(question.arguments)])]
        return turns.pop(0) if len(turns) > 1 else turns[0]

    order = prepared(Order(workspace, underlay, exercises, **about), folder)
    return judge(order, read_course(), ask)


# {recorder of what is stored: what it is called now}, until all is recorded again.
OLD, HANDOUT = "courses.handout.s4.record", "courses.handout"
MOVED = {
    "tutorial_check.recording.own_build:own_built": "tutorial_check.recording.build:own_built",
    f"{OLD}:bag": f"{HANDOUT}.driving.bag:bag",
    f"{OLD}:follow": f"{HANDOUT}.simulated_robot.record:follow",
    f"{OLD}:stick": f"{HANDOUT}.gamepad.record:stick",
    f"{HANDOUT}.driving.record:loaded": f"{HANDOUT}.joy2twist.record:loaded",
    f"{HANDOUT}.driving.record:found": f"{HANDOUT}.driving.record:known_package",
}
# How a recording of version 1 names folders, and how one of today.
WORDS = {
    "{handed_in}/handed_in": "{submission}",
    "{handed_in}/ws": "{submission}",
    "{handed_in}": "{scratch}",
}
# {part of a Joy2TwistRun: its fields, as they are stored, side by side; with the name of today}
PARTS = {
    "connections": "connected publishers subscribers types warnings master_alive",
    "numbered": "asked:sent samples first_samples missing unasked:extra came waits at_rest twists"
    " has_clock repeats shown:displayed",
    "probes": "answers unanswered",
    "stream": "sent answered strays:stray_zeros delays possible unavoidable_s",
    "ending": "ended_early:early output taken_s last_words",
}


def _in_parts(answer):
    """Return an answer with the fields that its recording has today."""
    run, recorder = answer.get("recording"), answer["recorder"]
    if run and recorder == f"{HANDOUT}.driving.record:drive" and "numbered" not in run:
        run = dict(run)
        for part, fields in PARTS.items():
            names = (field.partition(":")[::2] for field in fields.split())
            run[part] = {new or old: run.pop(old) for old, new in names if old in run}
    elif run and recorder == f"{HANDOUT}.driving.record:found":
        run = {"is_known": run["found"]}
    return {**answer, "recording": run} if run else answer


def of_today(recorded):
    """Return what is stored as it is recorded today. It goes when all is recorded again."""
    recorder = MOVED.get(recorded["recorder"], recorded["recorder"])
    recorded = _in_parts(recorded)
    if recorded["version"] > 1:
        return {**recorded, "recorder": recorder}
    text = json.dumps(recorded)
    for old, new in WORDS.items():
        text = text.replace(old, new)
    recorded = {**json.loads(text), "recorder": recorder}
    recorded["busy"], recorded["overloaded"] = recorded.pop("strained"), recorded.pop("hopeless")
    return recorded


def code_of(recordings):
    """Return {module of recorders: hash of its code, and of what it works with}."""
    modules = {one["recorder"].partition(":")[0] for one in recordings}
    return {name: code_hash(name) for name in sorted(modules)}
