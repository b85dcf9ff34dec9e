"""`./tutorial test faults`: a minute of it finds nothing in ours, and it would find something."""

import re

import pytest

LAST_LINE = r"(\d+) trials, (\d+) faults, (\d+) violations, worst time to rest (\d+\.\d+) s"


@pytest.mark.parametrize("arguments", [("--for", "60"), ("--in-a-cell", "--for", "25")])
def test_random_faults_violate_nothing(call, tmp_path, arguments):
    table = tmp_path / "table.csv"
    code, output = call("test", "faults", *arguments, "--table", str(table), deadline_s=900)
    trials, hits, violations, _ = re.fullmatch(LAST_LINE, output.splitlines()[-1]).groups()
    assert (code, int(violations)) == (0, 0), output
    assert int(hits) >= int(trials) > 0
    assert len(table.read_text().splitlines()) == int(trials) + 1


def test_the_handouts_class_drives_on_after_its_end_and_a_seed_repeats_it(call):
    """6.2 of the handout: one zero, then about 50 more velocities while its shutdown sleeps."""
    first = ("--node", "handout", "--kinds", "end:joy2twist", "--seed", "1", "--trials", "1")
    code, output = call("test", "faults", *first, deadline_s=900)
    assert code == 1, output
    assert re.search(r"\(d\) wheels turn \d\.\d+ s after the loss by end:joy2twist", output)
    again = re.search(r"again: \./tutorial test faults (.*)", output)[1].split()
    assert sorted(again) == sorted(first)
