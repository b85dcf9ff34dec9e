"""The libraries of all packages, for tests that run outside of a workspace, too."""

import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
sys.path[:0] = map(str, [*REPOSITORY.glob("*/src"), *REPOSITORY.glob("common/*/src")])
