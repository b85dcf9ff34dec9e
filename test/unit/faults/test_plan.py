"""What a trial does is drawn from its seed, and can be shortened."""

import pytest

from tutorial_faults.live.kinds import KINDS, LINK, MOUNT, SIMULATED, chosen
from tutorial_faults.live.plan import (
    BLOCKS,
    DRIVE,
    HELD,
    SIMULATED_BLOCK,
    Fault,
    Hand,
    Plan,
    draw,
    in_words,
    is_simulated,
)
from tutorial_faults.live.shrink import shrink

ALL = chosen([], (LINK, MOUNT, SIMULATED))
A, B, C = (Fault(kind, 0.1, 0.5, 0.5) for kind in ("unplug", "loss", "hang_master"))


def test_there_are_enough_kinds():
    assert len({KINDS[name].family for name in ALL}) >= 14


def test_a_seed_gives_the_same_trial_each_time_and_another_seed_another():
    assert [draw(seed, ALL) for seed in range(50)] == [draw(seed, ALL) for seed in range(50)]
    assert len({draw(seed, ALL).faults for seed in range(50)}) == 50


def test_every_kind_comes_alone_and_in_pairs():
    plans = [draw(seed, ALL) for seed in range(5000)]
    alone = {plan.faults[0].kind for plan in plans if len(plan.faults) == 1}
    pairs = {fault.kind for plan in plans if len(plan.faults) == 2 for fault in plan.faults}
    assert alone == pairs == set(ALL)


def test_two_faults_of_a_trial_hit_different_parts():
    for seed in range(2000):
        parts = [KINDS[fault.kind].part for fault in draw(seed, ALL).faults]
        parts = list(filter(None, parts))
        assert len(parts) == len(set(parts))


def test_faults_last_as_long_as_their_kind_says_and_within_the_trial():
    for seed in range(500):
        plan = draw(seed, ALL)
        for fault in plan.faults:
            low, high = KINDS[fault.kind].lasts_s
            assert low <= fault.lasts_s <= high
            assert 0.0 < fault.at_s < fault.end_s < plan.lasts_s < 6.0


def test_hands_begin_by_driving():
    for seed in range(500):
        hands = draw(seed, ALL).hands
        assert hands[0] == Hand(0.0, DRIVE)
        assert [hand.at_s for hand in hands] == sorted(hand.at_s for hand in hands)


def test_faults_of_the_clock_come_in_blocks_of_simulated_time_alone():
    first = SIMULATED_BLOCK * (BLOCKS - 1)
    assert [is_simulated(seed) for seed in (first - 1, first)] == [False, True]
    for seed in range(2 * SIMULATED_BLOCK * BLOCKS):
        plan = draw(seed, ALL)
        clocks = [f for f in plan.faults if KINDS[f.kind].needs == SIMULATED]
        assert plan.simulated == is_simulated(seed) == bool(clocks)


def test_of_the_clock_alone_all_is_simulated():
    assert all(draw(seed, ["clock_back"]).simulated for seed in range(10))


def test_what_is_not_granted_is_left_out():
    assert not {"loss", "full_disk"} & set(chosen([], (SIMULATED,)))
    assert chosen(["loss", "kill"], ()) == [name for name in ALL if KINDS[name].family == "kill"]


def test_an_unknown_kind_is_named_with_those_that_there_are():
    with pytest.raises(ValueError, match=r"^lost: is no kind of fault; there are .*loss"):
        chosen(["loss", "lost"], (LINK,))


def test_in_words():
    assert (
        in_words(Plan(1, False, (), (A, B)))
        == "unplug at 0.10 s for 0.50 s + loss at 0.10 s for 0.50 s"
    )
    assert in_words(Plan(1, False, (), ())) == "no fault"


@pytest.mark.parametrize("guilty", [(A,), (B,), (A, C), ()])
def test_shrinking_leaves_the_guilty_faults(guilty):
    hands = (Hand(0.0, DRIVE), Hand(1.0, "released"))
    fewest = shrink(Plan(1, False, hands, (A, B, C)), lambda p: set(guilty) <= set(p.faults))
    assert fewest == Plan(1, False, (Hand(0.0, DRIVE),), guilty)


def test_shrinking_keeps_hands_that_matter_and_tries_what_fails_once_again():
    hands, tries = (Hand(0.0, DRIVE), Hand(1.0, "released")), []

    def breaks(plan):
        tries.append(plan)
        return plan.hands == hands and len(tries) % 3 == 0

    assert shrink(Plan(1, False, hands, (A,)), breaks) == Plan(1, False, hands, ())


def test_what_is_held_is_one_word_each():
    assert set(HELD) == {"drive", "turn", "turbo"}
