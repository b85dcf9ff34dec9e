"""The compiler's first error: the student's line, its sentence, and the usual cause."""

from __future__ import annotations

import re

from tutorial_check.checking.compiler_places import ERROR, own_place, text_of
from tutorial_check.checking.header_errors import hint_of_header, is_outside
from tutorial_check.checking.make_output import EXPECTED, Target, build_hint, failed_target
from tutorial_check.checking.results import Wrong
from tutorial_check.checking.submission import Submission

OUTSIDE = "#include of a file outside of the package"
FOLLOWING = 5000  # characters, with the notes of an error
# A compiler that a limit of the system ends.
ENDED = re.compile(
    r"out of memory allocating|memory exhausted| signal terminated program "
    r"|internal compiler error: |unrecognized command-line option"
)
NEWER = re.compile(r"note: [^\n]{1,200} only available from (C\+\+\d\d) onwards")
# What the headers of ROS and Boost report if another C++ is asked for than they are written in.
STANDARD = re.compile(r"C\+\+ ?\d\d|ISO C\+\+ 2011|\brebind\b|in namespace .std. does not name")
STANDARD_WORDS = ("-std=", "CMAKE_CXX_STANDARD")
QUOTES = str.maketrans("‘’“”", "''\"\"")
NOISE = tuple(
    (re.compile(pattern), text)
    for pattern, text in (
        (r" \[with [^\n]*?\](?=[’']|$)", ""),
        (r" \[-fpermissive\]", ""),
        (r"\bstd::__cxx11::", "std::"),
        (r"\bstd::basic_string<char(?:, std::\w+<char> ?)*>", "std::string"),
        (r"(\w)_<std::allocator<void> ?>", r"\1"),
        (r"boost::shared_ptr<(?:const ([\w:]+)|([\w:]+) const) ?>", r"\1\2::ConstPtr"),
        (r"\b(?:struct|class) (?=\w+::)", ""),
    )
)
ALIAS = re.compile(r"‘([^‘’]*)’ \{aka ‘([^‘’]*)’\}")
OTHER_ALIAS = re.compile(r" \{aka [^{}\n]*\}")
INNER_TEMPLATE = re.compile(r"(\w<[^<>]*\w)<[^<>]*>")


def of_compiler(submission: Submission, output: str) -> Wrong | None:
    """Return the Wrong for the first error of the compiler, if there is one."""
    error, ended = ERROR.search(output), ENDED.search(output)
    if ended and not (error and error.start() < ended.start()):
        start, end = output[: ended.end()], output[ended.end() :]
        line = start.rpartition("\n")[2] + end.partition("\n")[0]
        return _ended(submission, line, failed_target(submission, output, ended.end()))
    if not error:
        return None
    place = own_place(submission, output, error)
    where = place.shown(submission) if place else f"{error[1]}:{error[2]}"
    if is_outside(submission, error[1]):
        return _outside(where if place else "")
    message = plain(error[4])
    target = failed_target(submission, output, error.end())
    newer = NEWER.search(output[error.end() : error.end() + FOLLOWING])
    standard = target.line_with(*STANDARD_WORDS)
    if standard and (newer or STANDARD.search(message)):
        return _wrong(message, standard, build_hint("compiler", "asks for another C++"))
    texts = (message, place.text(submission) if place else "", newer[0] if newer else "")
    hint = hint_of_header(submission, message, target) or _hint("\n".join(texts))
    return _wrong(message, where, hint)


def _hint(text: str) -> str:
    return build_hint("compiler", text.translate(QUOTES))


def _wrong(message: str, where: str, hint: str) -> Wrong:
    return Wrong(EXPECTED, message[:300], where, hint)


def _outside(where: str) -> Wrong:
    """Return the Wrong for an #include of a file that is no header. It quotes nothing of it."""
    return _wrong(OUTSIDE, where, build_hint("header", OUTSIDE))


def _ended(submission: Submission, message: str, target: Target) -> Wrong:
    """Return the Wrong for a compiler that could not finish."""
    where = target.line_with(*message.translate(QUOTES).split("'")[1:2])
    if where or not target.source or not target.package:
        return _wrong(message, where, _hint(message))
    source = target.package.folder / target.source
    where = f"{target.package.inside}/{target.source}"
    for number, line in enumerate(text_of(submission, source).split("\n"), 1):
        if line.lstrip().startswith("#") and re.search(r"[\"<]/|\.\./\.\./\.\.", line):
            return _outside(f"{where}:{number}")
    return _wrong(message, where, _hint(message))


def plain(message: str) -> str:
    """Return a sentence of the compiler without the noise of templates."""
    for pattern, text in NOISE:
        message = pattern.sub(text, message)
    message = ALIAS.sub(lambda names: f"‘{min(names.groups(), key=len)}’", message)
    message = OTHER_ALIAS.sub("", message)
    shorter = INNER_TEMPLATE.sub(r"\1", message)
    while shorter != message:
        message, shorter = shorter, INNER_TEMPLATE.sub(r"\1", shorter)
    return message
