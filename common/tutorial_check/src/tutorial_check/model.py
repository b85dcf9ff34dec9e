"""What a check can come to, and the order in which checks are made. Pure."""

import re
import time
import traceback
from dataclasses import asdict, dataclass
from pathlib import Path

OK, WRONG, NOTE, UNREACHED = "ok", "wrong", "note", "unreached"
LINE = re.compile(r":\d+$")  # of a file, at the end of a place


@dataclass(frozen=True)
class Result:
    """What one check came to, in the student's words."""

    id: str
    status: str
    title: str
    expected: str = ""
    seen: str = ""
    where: str = ""
    hint: str = ""
    section: str = ""
    look: str = ""  # a command with which to see it oneself
    empty: bool = False  # a note that there was nothing to be checked

    def as_dict(self):
        """The result as --json has it."""
        return asdict(self)


@dataclass(frozen=True)
class Note:
    """A check that holds, with something worth saying."""

    seen: str
    where: str = ""
    hint: str = ""
    empty: bool = False  # there was nothing to be checked


class Wrong(Exception):
    """A check that does not hold. Raised by checks, which so end at the first thing wrong."""

    look = ""  # a command with which to see it oneself, if not that of the check

    def __init__(self, expected, seen, where="", hint="", sure=False):
        """sure: whatever else the machine had to do, it is no matter of time."""
        super().__init__(f"expected {expected}; seen {seen}")
        self.expected, self.seen, self.where, self.hint = expected, seen, where, hint
        self.sure = sure


def master_gone(where=""):
    """The Wrong for a program that ends the master."""
    return Wrong(
        "the ROS master is left alone",
        "it no longer answers: a program of yours has ended it",
        where,
        "a node ends itself (rospy.signal_shutdown), never the master",
        sure=True,
    )


class CannotCheck(Exception):
    """The checker cannot work, through no fault of the student's; the text says why in one line."""


def fault(error):
    """In one line why an exception keeps the checker from working; where, if it is a fault of ours."""
    if isinstance(error, CannotCheck):
        return str(error)
    line = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({Path(line.filename).name}:{line.lineno})"


@dataclass(frozen=True)
class Check:
    """One line of the report."""

    id: str
    exercise: str
    title: str
    section: str  # of the handout
    needs: tuple = ()  # ids of the checks without which this one says nothing
    look: str = ""
    timeless: bool = False  # it reads files alone: no machine is too busy for that


class Catalogue:
    """All checks, in order, with the function that makes each."""

    def __init__(self, checks, functions):
        """checks: Check objects; functions: id -> function(session), of each of them."""
        self.checks = {check.id: check for check in checks}
        self.functions = functions
        if set(self.checks) != set(functions):
            raise ValueError(
                f"checks without or with too many functions: {set(self.checks) ^ set(functions)}"
            )

    def of(self, exercise):
        """The checks of an exercise."""
        return [check for check in self.checks.values() if check.exercise == exercise]


class Run:
    """Makes checks, each at most once, and none whose ground is missing."""

    def __init__(
        self, catalogue, session, second_look=lambda explained: False, too_busy=lambda: False
    ):
        """session: what the functions of the catalogue take.

        second_look(explained): asked once for a check that does not hold; whether to make it again.
        explained: whether a line of the student's is to blame.
        too_busy(): asked if it does not hold then, either; whether that says nothing.
        """
        self._catalogue = catalogue
        self._session = session
        self._second_look, self._too_busy = second_look, too_busy
        self._done = {}
        self._blocked_by = {}  # id of a check not reached -> the results that are to blame
        self._told = set()
        self._troubles = {}  # id of a check that could not be made -> why
        self.seconds = {}  # that each check took, with those it needs

    def result(self, check_id):
        """The Result of a check; made now if it was not yet."""
        if check_id not in self._done:
            began_s = time.monotonic()
            self._done[check_id] = self._make(self._catalogue.checks[check_id])
            self.seconds[check_id] = round(time.monotonic() - began_s, 2)
        return self._done[check_id]

    def exercise(self, exercise, tell=lambda result: None, only_first=False):
        """The results of an exercise, each told as soon as it is there.

        only_first: whether to end at the first that is wrong.

        What is wrong in an earlier exercise and keeps this one from being checked comes first,
        unless it was told before.
        """
        results = []

        def add(result):
            if result.id not in self._told or result.status != WRONG:
                results.append(result)
                self._told.add(result.id)
                tell(result)

        for check in self._catalogue.of(exercise):
            for culprit in self._culprits(check):
                elsewhere = self._catalogue.checks[culprit.id].exercise != exercise
                if elsewhere and culprit.id not in self._told:
                    add(culprit)
            add(self.result(check.id))
            if only_first and any(result.status == WRONG for result in results):
                break
        return results

    def trouble(self, exercise):
        """Why a check of the exercise could not be made, though nothing is wrong with it; or empty."""
        own = [check.id for check in self._catalogue.of(exercise)]
        return next((f"{one}: {self._troubles[one]}" for one in own if one in self._troubles), "")

    def _culprits(self, check):
        for needed in check.needs:
            result = self.result(needed)
            if result.status == WRONG:
                yield result
            elif result.status == UNREACHED:
                yield from self._blocked_by[needed]

    def _make(self, check):
        culprits = list(self._culprits(check))
        if culprits:
            return self._unreached(check, culprits)
        about = {"id": check.id, "title": check.title, "section": check.section, "look": check.look}
        try:
            found = self._call(check)
        except Wrong as wrong:
            same = self._told_of(wrong)
            if same:  # one cause is told once, at the first check that it keeps from holding
                return self._unreached(check, same)
            what = {
                "expected": wrong.expected,
                "seen": wrong.seen,
                "where": wrong.where,
                "hint": wrong.hint,
            }
            about["look"] = wrong.look or check.look
            return Result(status=WRONG, **about, **what)
        except Exception as error:  # also a fault of ours: the other checks are made all the same
            if not isinstance(error, CannotCheck):
                traceback.print_exc()
            return self._not_checked(about, fault(error))
        if isinstance(found, Note):
            return Result(status=NOTE, **vars(found), **about)
        return Result(status=OK, seen=found or "", **about)

    def _told_of(self, wrong):
        """The wrong results that tell of the same cause."""
        return [
            one for one in self._done.values() if one.status == WRONG and _is_one_cause(one, wrong)
        ]

    def _call(self, check):
        function = self._catalogue.functions[check.id]
        try:
            return function(self._session)
        except (Wrong, CannotCheck) as error:
            sure = isinstance(error, Wrong) and (error.sure or check.timeless)
            if sure or (isinstance(error, Wrong) and self._told_of(error)):
                raise
            if not self._second_look(bool(LINE.search(getattr(error, "where", "")))):
                raise
        try:
            return function(self._session)
        except Wrong as wrong:
            if wrong.sure or not self._too_busy():
                raise
            raise CannotCheck(
                f"{check.id}: the machine has too much else to do for a verdict ({wrong.seen})"
            ) from None

    def _not_checked(self, about, why):
        self._troubles[about["id"]] = why
        result = Result(status=UNREACHED, seen=f"could not be checked: {why}", **about)
        self._blocked_by[result.id] = [result]
        return result

    def _unreached(self, check, culprits):
        self._blocked_by[check.id] = culprits
        first = culprits[0]
        why = f"first mend {first.id}: {first.title}"
        if first.status == UNREACHED:
            why = f"{first.id} could not be checked"
        return Result(
            id=check.id,
            status=UNREACHED,
            title=check.title,
            section=check.section,
            look=check.look,
            seen=why,
        )


def _is_one_cause(result, wrong):
    """Whether a Result tells of what a Wrong is about. "No such file" alone may be said of two files."""
    is_same = (result.seen, result.where) == (wrong.seen, wrong.where)
    return is_same and (bool(LINE.search(wrong.where)) or result.expected == wrong.expected)


def passed(results):
    """Whether an exercise is done: nothing wrong, and everything reached."""
    return all(result.status in (OK, NOTE) for result in results)
