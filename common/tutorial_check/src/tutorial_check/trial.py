"""Whether programs of the student's can be started here and reach what they need, before any is blamed."""

from pathlib import Path

from tutorial_check.model import CannotCheck
from tutorial_check.place import own_rights

SLOW_S = 60  # [s] for what needs a hundredth of one
# Prints the first folder that may not be entered.
SCRIPT = '#!/bin/sh\nfor folder do [ -x "$folder" ] || { echo "$folder"; exit; }; done\n'


def must_be_possible(box, scratch, needed=()):
    """Start a program of the box's in the folder for what is written. Raises CannotCheck.

    needed: files and folders that it has to reach.
    """
    script = Path(scratch) / "trial"
    if not script.exists():  # the second time the folder is closed to us, too
        script.write_text(SCRIPT)
        script.chmod(0o755)
    needed = [Path(each) for each in needed]
    above = (folder for each in needed for folder in (*reversed(each.parents), each))
    with own_rights():
        folders = [str(each) for each in dict.fromkeys(above) if each.is_dir()]
    try:
        program = box.start([str(script), *folders])
    except OSError as error:
        raise CannotCheck(
            f"no program can be started in {script.parents[1]} ({error.strerror}): set TMPDIR to a folder"
            " that others may enter, and that is not mounted noexec"
        ) from None
    box.wait(lambda: program.ended, SLOW_S)
    box.end(program)
    if program.output:
        closed = Path(program.output.strip())
        # What lies below one that was made so is as closed; but a home folder is opened no further.
        is_needed = set(needed) & {closed, *closed.parents}
        raise CannotCheck(
            f"{closed} is closed to others, as one of whom the programs run:"
            f" {'chmod -R o+rX' if is_needed else 'chmod o+x'} {closed},"
            " or keep this suite, and TUTORIAL_WORKSPACE, where others may enter"
        )
