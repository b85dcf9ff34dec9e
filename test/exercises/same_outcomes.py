"""Write the outcomes of all stored rows as JSON, to be compared before and after a move.

pytest -p same_outcomes test/unit/tutorial_check/test_stored_rows.py, with OUTCOMES=FOLDER.
"""

import dataclasses
import json
import os
import re
from pathlib import Path

FOLDER = Path(os.environ["OUTCOMES"])
NO_WORD = re.compile(r"[^\w.-]+")
MADE = re.compile(r"/tmp/(pytest-of-[^/]*/[^\"' ]*?(?=judged)|tmp\w{8})")


def pytest_collection_finish(session):
    import stored  # noqa: PLC0415  beside conftest.py

    judged = stored.judged

    def kept(test, workspace, *rest, **about):
        outcomes = judged(test, workspace, *rest, **about)
        rows = [dataclasses.asdict(outcome) for outcome in outcomes]
        for row in rows:
            del row["recordings"], row["seconds"]
        text = json.dumps(rows, indent=1, sort_keys=True, default=str)
        names = {**stored.names(workspace, os.environ["TUTORIAL_UNDERLAY"]), str(workspace): "W"}
        for path, name in names.items():
            text = text.replace(path, name)
        FOLDER.mkdir(exist_ok=True)
        name = NO_WORD.sub("_", test)[:120]
        file = FOLDER / f"{name}.json"
        file.write_text(MADE.sub("made", text))
        return outcomes

    stored.judged = kept
