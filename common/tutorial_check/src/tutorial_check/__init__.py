"""The checker of the exercises, and everything that a course's checks and recorders use.

A course imports nothing else of this package; common/doc/COURSES.md shows an example.
"""

from typing import TYPE_CHECKING

from tutorial_check.checking.build_errors import build_error, missing_in, not_found
from tutorial_check.checking.builds import build_output, cmake_of, must_build
from tutorial_check.checking.causes import is_lacking, meant, packages_of_ros, with_import
from tutorial_check.checking.checks import check
from tutorial_check.checking.cpp_causes import never_calls_back, unsubscribed
from tutorial_check.checking.crashes import cause_of, crash, traceback_of
from tutorial_check.checking.launch_errors import package_hint
from tutorial_check.checking.launch_file import LaunchFile, find_launch, launch_file
from tutorial_check.checking.manifest_errors import must_be_unique, unreadable
from tutorial_check.checking.package_files import File, Script, in_cpp
from tutorial_check.checking.packages import must_be_launchable, package_of
from tutorial_check.checking.programs import find_script, must_be_one_program, program_of, recorded
from tutorial_check.checking.results import Note, Wrong, first_of, must_pass, wrong_of
from tutorial_check.checking.script_faults import check_file
from tutorial_check.checking.submission import Submission
from tutorial_check.checking.texts import read_xml
from tutorial_check.course.tasks import Task, Variant
from tutorial_check.data.recordings import Heard, HeardText, LaunchNode, Ran, Topics
from tutorial_check.errors import MASTER_GONE, CannotCheck, CutShort
from tutorial_check.processes.runner import GRACE_S
from tutorial_check.processes.started_program import Program
from tutorial_check.recording.client import Client, FrameTransform, Seen, ServiceAnswer
from tutorial_check.recording.launch_files import Launch
from tutorial_check.recording.ros_session import SETTLE_S, START_S, RosSession
from tutorial_check.recording.simulated_turtlebot import (
    BUMPER,
    ODOM,
    TRUTH,
    PoseSample,
    SimulatedTurtleBot,
    has_moved,
)
from tutorial_check.recording.workspace import Workspace
from tutorial_check.submission.aborts import has_error, has_failed
from tutorial_check.submission.idioms import Idioms
from tutorial_check.submission.launch_xml import GAPS, attribute, line_of, place_of
from tutorial_check.submission.manifests import is_stand_in
from tutorial_check.submission.packages import Package, packages_beside, underlays
from tutorial_check.submission.python_facts import PythonFacts, shows
from tutorial_check.submission.python_text import flipped_anonymous, unmasked, without_name
from tutorial_check.submission.source_facts import ClassFacts, SourceFacts, with_bases
from tutorial_check.submission.student_files import put_file
from tutorial_check.submission.tracebacks import first_traceback, last_lines

if TYPE_CHECKING:  # its module loads ROS
    from tutorial_check.recording.virtual_gamepad import VirtualGamepad as VirtualGamepad

__all__ = [
    "BUMPER", "GAPS", "GRACE_S", "MASTER_GONE", "ODOM", "SETTLE_S", "START_S", "TRUTH",
    "CannotCheck", "ClassFacts", "Client", "CutShort", "File", "FrameTransform", "Heard",
    "HeardText", "Idioms", "Launch", "LaunchFile", "LaunchNode", "Note", "Package", "PoseSample",
    "Program", "PythonFacts", "Ran", "RosSession", "Script", "Seen", "ServiceAnswer",
    "SimulatedTurtleBot", "SourceFacts", "Submission", "Task", "Topics", "Variant", "Workspace",
    "Wrong", "attribute", "build_error", "build_output", "cause_of", "check", "check_file",
    "cmake_of", "crash", "find_launch", "find_script", "first_of", "first_traceback",
    "flipped_anonymous", "has_error", "has_failed", "has_moved", "in_cpp", "is_lacking",
    "is_stand_in", "last_lines", "launch_file", "line_of", "meant", "missing_in",
    "must_be_launchable", "must_be_one_program", "must_be_unique", "must_build", "must_pass",
    "never_calls_back", "not_found", "package_hint", "package_of", "packages_beside",
    "packages_of_ros", "place_of", "program_of", "put_file", "read_xml", "recorded", "shows",
    "traceback_of", "underlays", "unmasked", "unreadable", "unsubscribed", "with_bases",
    "with_import", "without_name", "wrong_of",
]  # fmt: skip
