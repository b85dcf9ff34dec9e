"""The results of many trials, as a table and as the last line (pure)."""

import csv
from typing import NamedTuple, Tuple

from tutorial_faults.live.kinds import KINDS

FIELDS = ("seed", "kinds", "rest_s", "violations")


class Result(NamedTuple):
    """One trial. kinds: of its faults. rest_s: longest time to rest [s]. violations: letters."""

    seed: int
    kinds: Tuple[str, ...]
    rest_s: float
    violations: Tuple[str, ...]


def write(file, results, header=True):
    """Write results as rows of CSV to an open file."""
    rows = csv.writer(file)
    if header:
        rows.writerow(FIELDS)
    for one in results:
        rows.writerow([one.seed, "+".join(one.kinds), f"{one.rest_s:.3f}", "".join(one.violations)])


def read(file):
    """The results in an open file that write() wrote."""
    return [
        Result(
            int(row["seed"]),
            tuple(filter(None, row["kinds"].split("+"))),
            float(row["rest_s"]),
            tuple(row["violations"]),
        )
        for row in csv.DictReader(file)
    ]


def last_line(results):
    """What the hunt ends with."""
    faults = sum(len(one.kinds) for one in results)
    violations = sum(bool(one.violations) for one in results)
    worst_s = max((one.rest_s for one in results), default=0.0)
    return (
        f"{len(results)} trials, {faults} faults, {violations} violations, "
        f"worst time to rest {worst_s:.2f} s"
    )


def by_kind(results):
    """Lines of a table: kind, trials with it alone and in pairs, violations, worst times."""
    lines = [
        "| kind | alone | in pairs | violations | worst time to rest alone, in pairs [s] |",
        "|---|---|---|---|---|",
    ]
    for kind in KINDS:
        having = [one for one in results if kind in one.kinds]
        if not having:
            continue
        alone = [one for one in having if len(one.kinds) == 1]
        pairs = [one for one in having if len(one.kinds) > 1]
        worst = ", ".join(
            f"{max(one.rest_s for one in group):.2f}" if group else "-" for group in (alone, pairs)
        )
        broken = sum(bool(one.violations) for one in having)
        lines.append(f"| `{kind}` | {len(alone)} | {len(pairs)} | {broken} | {worst} |")
    return lines


def beside(results_of):
    """Lines of a table: in how many trials each invariant was violated, one column for each.

    results_of: from a name to its results.
    """
    names = list(results_of)
    letters = sorted(
        {letter for results in results_of.values() for one in results for letter in one.violations}
    )
    lines = [
        "| invariant | "
        + " | ".join(f"{name}, of {len(results_of[name])}" for name in names)
        + " |",
        "|---" * (1 + len(names)) + "|",
    ]
    for letter in letters:
        counts = [sum(letter in one.violations for one in results_of[name]) for name in names]
        lines.append(f"| {letter} | {' | '.join(map(str, counts))} |")
    worst = [max((one.rest_s for one in results_of[name]), default=0.0) for name in names]
    return [*lines, f"| worst time to rest [s] | {' | '.join(f'{s:.2f}' for s in worst)} |"]
