"""`./tutorial test faults`: a minute of it finds nothing in ours, and it would find something."""

import re
import subprocess

LAST_LINE = r"(\d+) trials, (\d+) faults, (\d+) violations, worst time to rest (\d+\.\d+) s"


def faults(tutorial, *arguments):
    """Return (exit code, output) of ./tutorial test faults."""
    done = subprocess.run(
        [tutorial, "test", "faults", *arguments], check=False, text=True, timeout=900,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    return done.returncode, done.stdout


def test_a_minute_of_random_faults_violates_nothing(tutorial, tmp_path):
    code, output = faults(tutorial, "--for", "60", "--table", str(tmp_path / "table.csv"))
    trials, hits, violations, _ = re.fullmatch(LAST_LINE, output.splitlines()[-1]).groups()
    assert (code, int(violations)) == (0, 0), output
    assert int(hits) >= int(trials) > 0
    assert len((tmp_path / "table.csv").read_text().splitlines()) == int(trials) + 1


def test_in_a_cell_nothing_pushes_or_falls(tutorial):
    code, output = faults(tutorial, "--in-a-cell", "--for", "25")
    trials, _, violations, _ = re.fullmatch(LAST_LINE, output.splitlines()[-1]).groups()
    assert (code, int(violations)) == (0, 0), output
    assert int(trials) > 0


def test_the_handouts_class_drives_on_after_its_end_and_a_seed_repeats_it(tutorial):
    """6.2 of the handout: one zero, then about 50 more velocities while its shutdown sleeps."""
    first = ("--node", "handout", "--kinds", "end:joy2twist", "--seed", "1", "--trials", "1")
    code, output = faults(tutorial, *first)
    assert code == 1, output
    assert re.search(r"\(d\) wheels turn \d\.\d+ s after the loss by end:joy2twist", output)
    again = re.search(r"again: \./tutorial test faults (.*)", output)[1].split()
    assert sorted(again) == sorted(first)
