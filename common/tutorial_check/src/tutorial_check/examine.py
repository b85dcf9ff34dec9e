"""The examination itself, in its place apart: python3 -m tutorial_check.examine.

Its orders come as JSON on standard input; what it finds goes out as JSON lines through a socket that
no program of the student's ever has: unlike a pipe, no path in /proc opens it: {"exercise": id, "result": {...}}, {"exercise": id, "done":
seconds, "trouble": why it could not be checked as a whole, or ""}, and at the end {"end": true} or
{"cannot": "why"}.
"""

import functools
import importlib
import json
import os
import shlex
import shutil
import signal
import sys
import time
import traceback
from pathlib import Path

from tutorial_check import limits, place, workspace
from tutorial_check.model import CannotCheck, Run, fault


def main():
    """Read the orders, examine, tell."""
    os.umask(0o022)  # what we write is read by programs that run as somebody else
    place.keep_to_itself()
    orders = json.load(sys.stdin)
    if orders["apart"]:
        place.end_with_parent()  # which is bwrap
        place.limit_shared_memory()
    else:  # its box notices that the one who reads has ended, and ends what was started
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        place.adopt_orphans()  # in a container nobody else may reap them
    told = os.fdopen(os.dup(1), "w", buffering=1)
    os.set_inheritable(told.fileno(), False)
    os.dup2(2, 1)  # nothing else gets into what is told

    def tell(**what):
        told.write(json.dumps(what) + "\n")

    try:
        examine(orders, tell, told.fileno())
        tell(end=True)
    except Exception as error:  # whatever it is, it is no fault of the student's
        if not isinstance(error, CannotCheck):
            traceback.print_exc()
        tell(cannot=fault(error))
    finally:  # who made the folder may have been killed
        place.restore_rights()
        shutil.rmtree(orders["folder"], ignore_errors=True)


def examine(orders, tell, told):
    """orders: layout, folder, floor, exercises, apart, only_first ...; told: see Box."""
    began_s = time.monotonic()
    scratch = Path(orders["folder"])
    root, source, is_workspace = orders["layout"]
    layout = workspace.Layout(Path(root), Path(source), is_workspace)
    shutil.copytree(scratch / workspace.COPY, scratch / "ws" / "src", symlinks=True)
    # Before ROS, which reads the environment as it loads.
    home = scratch / "ours"
    home.mkdir(exist_ok=True)
    os.environ.update(HOME=str(home), ROS_HOME=str(home), ROS_LOG_DIR=str(home), ROS_IP="127.0.0.1")
    os.environ.pop("ROS_HOSTNAME", None)

    from tutorial_check import box, session, trial  # noqa: PLC0415
    from tutorial_check.exercises import catalogue  # noqa: PLC0415

    uid = limits.user(orders["number"], _uid_map()) if os.geteuid() == 0 else None
    session.prepare(scratch, uid)
    scratch.chmod(0o755)
    one = session.Session(
        scratch,
        layout,
        orders["exercises"],
        orders["environment"],
        floor=orders["floor"],
        make_box=lambda environment: box.Box(environment, uid, orders["apart"], told),
        can_have_devices=orders["apart"],
        needed=[*orders["kept"], Path(__file__)],
    )
    trial.must_be_possible(one.box, scratch)
    checks = catalogue()
    if uid is not None:
        if not orders["apart"]:  # then the suite may lie where that user cannot read
            importlib.import_module("rosbag")
            importlib.import_module("tutorial_check.driver")
        os.setgroups([])
        place.touch_files_as(uid, uid)
    run = Run(checks, one, one.second_look, one.box.patience.hopeless)
    as_told = functools.partial(in_the_students_words, scratch, layout, orders["own"])
    times = {"prepare": round(time.monotonic() - began_s, 2)}
    try:
        for exercise in orders["exercises"]:
            began_s = time.monotonic()
            run.exercise(
                exercise,
                lambda result, exercise=exercise: tell(exercise=exercise, result=as_told(result)),
                orders["only_first"],
            )
            seconds = round(time.monotonic() - began_s, 2)
            tell(exercise=exercise, done=seconds, trouble=run.trouble(exercise))
    finally:
        one.box.clear()  # a build, too, is ended; where no namespace is, nothing else does that
    if "TUTORIAL_CHECK_TIMES" in os.environ:
        print({**times, **run.seconds}, file=sys.stderr)


def in_the_students_words(scratch, layout, own, result):
    """Return a Result as a dict, with the paths of the copy as the student knows them.

    own: whether it is the caller's own workspace, so that commands can name whole paths.
    """
    copied = f"{scratch}/ws/" if layout.is_workspace else f"{scratch}/ws/src/"
    is_unpacked = scratch in layout.root.parents
    root = f"{shlex.quote(str(layout.root))}/" if own and not is_unpacked else ""
    return {
        name: words.replace(copied, root if name in ("hint", "look") else "")
        if isinstance(words, str)
        else words
        for name, words in result.as_dict().items()
    }


def _uid_map():
    try:
        return Path("/proc/self/uid_map").read_text()
    except FileNotFoundError:  # a kernel that maps no ids
        return ""


if __name__ == "__main__":
    main()
