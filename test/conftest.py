"""The libraries of all packages, for tests that run outside of a workspace, too."""

import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
FOLDERS = ("*/src", "common/*/src", "common/stand_ins/*/src")
sys.path[:0] = [str(folder) for pattern in FOLDERS for folder in REPOSITORY.glob(pattern)]
