#!/usr/bin/python3
"""Write test/CLAIMS.md from the claims of the tests, or --check it; exit code 1 if one is wrong.

`@claim("sentence")` is above a test or class, or a file's pytestmark; a .mjs file has a comment.
A second test gives a reason, `because=`, and may shorten the sentence: "Each Joy ...".
"""

import ast
import itertools
import re
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent
PAGE = TESTS / "CLAIMS.md"
CLAIMED = {"ros", "system", "browser"}  # each test of these kinds shows a claim
HEAD = """# Claims

What the suite promises, and the test that shows it; a second one for what the first cannot show.
`./tutorial lint --fix` writes this page from `@claim("...")` above the tests.
"""


def claims_of(test, body, expressions, bare, inherited=False):
    """Yield (sentence, because, test) of a file, class or test; append tests without to bare."""
    expressions = [*expressions, *(node.value for node in body if isinstance(node, ast.Assign))]
    nodes = itertools.chain.from_iterable(map(ast.walk, expressions))
    calls = [node for node in nodes if getattr(getattr(node, "func", None), "id", "") == "claim"]
    for call in calls:
        yield call.args[0].value, "".join(word.value.value for word in call.keywords), test
    claimed = inherited or bool(calls)
    if not claimed and "::test_" in test:
        bare.append(test)
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            inside = node.body if isinstance(node, ast.ClassDef) else []
            yield from claims_of(f"{test}::{node.name}", inside, node.decorator_list, bare, claimed)


def claims_in(path, wrong):
    """Yield (sentence, because, test) of each claim in a file; append what is wrong."""
    test, text, bare = str(path.relative_to(TESTS.parent)), path.read_text(), []
    if path.suffix == ".mjs":
        yield from ((sentence, "", test) for sentence in re.findall("^// claim: (.+)", text, re.M))
    else:
        yield from claims_of(test, ast.parse(text).body, [], bare)
    if path.relative_to(TESTS).parts[1] in CLAIMED:
        wrong += [f"{test}: it shows no claim" for test in bare]


def page(claims, wrong):
    """Return the text of the page; append what is wrong."""
    shown = {}  # {sentence: its tests}
    for sentence, because, test in sorted(claims, key=lambda claim: bool(claim[1])):
        if not because and sentence in shown:
            wrong.append(f"{test}: another test shows this, too; say because=: {sentence}")
        elif not because:
            shown[sentence] = [f"`{test}`"]
        else:
            beginning = sentence[:-4] if sentence.endswith(" ...") else sentence
            meant = [whole for whole in shown if whole.startswith(beginning)]
            if len(meant) != 1:
                wrong.append(f"{test}: {len(meant)} claims begin so: {sentence}")
            for whole in meant:
                shown[whole].append(f"`{test}` ({because})")
    lines = [HEAD]
    for package, group in itertools.groupby(
        shown, lambda sentence: shown[sentence][0].split("/")[1]
    ):
        lines.append(f"## {package}\n")
        lines += [f"- {sentence} — {', '.join(shown[sentence])}" for sentence in group]
        lines.append("")
    return "\n".join(lines)


if __name__ == "__main__":
    wrong = []
    files = sorted(path for end in ("py", "mjs") for path in TESTS.glob(f"*/*/**/*.{end}"))
    text = page([claim for path in files for claim in claims_in(path, wrong)], wrong)
    if "--check" not in sys.argv:
        PAGE.write_text(text)
    elif PAGE.read_text() != text:
        wrong.append("test/CLAIMS.md is old, which ./tutorial lint --fix renews")
    sys.exit("\n".join(wrong) or None)
