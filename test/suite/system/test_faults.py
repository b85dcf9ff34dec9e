"""`./tutorial test faults`: it finds nothing in our nodes, and would find a fault."""

import re

import pytest

from tutorial_testing.claims import claim

LAST_LINE = r"(\d+) trials, (\d+) faults, (\d+) violations, worst time to rest (\d+\.\d+) s"


@claim("`./tutorial test faults` finds nothing in ours")
@pytest.mark.parametrize("base", [(), ("--serial",)], ids=["simulated", "on a serial line"])
def test_random_faults_violate_nothing(call, base):
    code, output = call("test", "faults", *base, "--trials", "5", deadline_s=900)
    trials, hits, violations, _ = re.fullmatch(LAST_LINE, output.splitlines()[-1]).groups()
    assert (code, int(violations)) == (0, 0), output
    assert int(hits) >= int(trials) > 0


@claim("`./tutorial test faults` finds what is wrong, and a seed repeats it")
@pytest.mark.parametrize(
    ("fault", "violation"),
    [
        # 6.2 of the handout: one zero, then about 50 more velocities while its shutdown sleeps.
        ("end:joy2twist", r"\(d\) wheels turn \d\.\d+ s after the loss by end:joy2twist"),
        # A restarted base obeys a program that goes on sending.
        ("kill:base", r"\(b\) moved again after \d\.\d+ s"),
    ],
)
def test_a_hunt_finds_that_the_handouts_class_drives_on(call, fault, violation):
    first = ("--node", "handout", "--kinds", fault, "--seed", "1", "--trials", "1")
    code, output = call("test", "faults", *first, deadline_s=900)
    assert code == 1, output
    assert re.search(violation, output)
    again = re.search(r"again: \./tutorial test faults (.*)", output)[1].split()
    assert sorted(again) == sorted(first)
