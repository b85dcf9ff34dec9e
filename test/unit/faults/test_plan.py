"""A trial is drawn from its seed, from kinds that hit different parts."""

from tutorial_faults.live.kinds import KINDS, LINK, MOUNT, chosen
from tutorial_faults.live.plan import Fault, Hand, Plan, draw

ALL = chosen([], (LINK, MOUNT))
A, B = (Fault(kind, 0.1, 0.5, 0.5) for kind in ("unplug", "loss"))
PLANS = [draw(seed, ALL) for seed in range(5000)]


def test_a_seed_gives_the_same_trial_each_time_and_another_seed_another():
    assert [draw(seed, ALL) for seed in range(50)] == PLANS[:50]
    assert len({plan.faults for plan in PLANS[:50]}) == 50


def test_every_kind_is_drawn_alone_and_in_pairs_that_hit_different_parts():
    alone = {plan.faults[0].kind for plan in PLANS if len(plan.faults) == 1}
    pairs = {fault.kind for plan in PLANS if len(plan.faults) == 2 for fault in plan.faults}
    assert alone == pairs == set(ALL)
    for plan in PLANS:
        parts = [KINDS[fault.kind].part for fault in plan.faults]
        parts = list(filter(None, parts))
        assert len(parts) == len(set(parts))


def test_faults_last_as_their_kind_says_within_the_trial_and_hands_begin_by_driving():
    for plan in PLANS:
        assert plan.hands[0] == Hand(0.0, "drive")
        assert list(plan.hands) == sorted(plan.hands, key=lambda hand: hand.at_s)
        for fault in plan.faults:
            low, high = KINDS[fault.kind].lasts_s
            assert low <= fault.lasts_s <= high
            assert 0.0 < fault.at_s < fault.end_s < plan.lasts_s < 6.0


def test_what_is_not_granted_is_left_out():
    assert not {"loss", "full_disk"} & set(chosen([], ()))
    assert chosen(["loss", "kill"], ()) == [name for name in ALL if KINDS[name].family == "kill"]


def test_in_words():
    words = "unplug at 0.10 s for 0.50 s + loss at 0.10 s for 0.50 s"
    assert [str(Plan(1, (), (A, B), 0.0)), str(Plan(1, (), (), 0.0))] == [words, "no fault"]
