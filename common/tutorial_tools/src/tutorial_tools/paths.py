"""Where this suite and ROS are."""

import os
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[4]
# The prefix of a ROS that is not the system's own, as ./tutorial sets it.
PREFIX = os.environ.get("TUTORIAL_ROS", "")
SHARE = Path(PREFIX or "/usr", "share")  # ROS packages
