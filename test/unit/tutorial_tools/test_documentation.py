"""README.md lists what the doctor looks at."""

import re
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[3] / "common" / "tutorial_tools"


def test_what_the_doctor_looks_at():
    folder = PACKAGE / "src/tutorial_tools/doctor"
    source = "".join((folder / name).read_text() for name in ("judgement.py", "way.py"))
    looked_at = set(re.findall(r'Finding\(\s*(?:\w+|OK if well else WRONG),\s*"(\w+)"', source))
    section = (PACKAGE / "README.md").read_text().split("## When nothing moves")[1].split("##")[0]
    assert set(re.findall(r"^\| `(\w+)` \|", section, re.M)) == looked_at
