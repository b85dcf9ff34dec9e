"""The judge of a trial, with records written by hand: what it finds, and what it lets pass."""

import math

import pytest

from tutorial_faults.events import Twist, Violation, Wheels
from tutorial_faults.live.judge import LIMIT_S, Injury, Record, judge
from tutorial_faults.live.kinds import KINDS

DT = 0.02


def wheels(*phases):
    """Odometry of 50 Hz. phases: (until [s], speed [m/s])."""
    made, now = [], 0.0
    for until, speed in phases:
        while now < until - 1e-9:
            made.append(Wheels(now, speed, 0.0))
            now += DT
    return made


def found(hands=((0.0, "drive"),), injuries=(), turn=(), **more):
    """The letters of the invariants that are violated, and the time to rest."""
    record = Record(list(hands), list(injuries), wheels(*turn), **more)
    judgement = judge(record)
    return "".join(v.invariant for v in judgement.violations), judgement.rest_s


def test_a_quiet_drive_is_well():
    assert found(((0.0, "drive"), (1.0, "released")), turn=((1.1, 0.3), (2.0, 0.0)))[0] == ""


@pytest.mark.parametrize("shows", ["released", "stick"])
def test_a_wheels_that_turn_without_a_dead_man(shows):
    hands = ((0.0, "drive"), (1.0, shows))
    assert found(hands, turn=((1.0 + LIMIT_S - DT, 0.3), (2.0, 0.0)))[0] == ""
    assert found(hands, turn=((1.0 + LIMIT_S + 2 * DT, 0.3), (2.0, 0.0)))[0] == "a"


@pytest.mark.parametrize("kind", ["kill:joy_node", "stop:mux", "unplug", "link_down"])
def test_d_a_part_is_lost_and_the_wheels_turn_on(kind):
    injuries = (Injury(kind, 0.5, 2.0),)
    letters, rest_s = found((((0.0, "drive")),), injuries, ((1.0, 0.3), (2.0, 0.0)))
    assert (letters, rest_s) == ("", pytest.approx(0.5, abs=DT))
    assert found(((0.0, "drive"),), injuries, ((0.5 + LIMIT_S + 2 * DT, 0.3), (2.0, 0.0)))[0] == "d"


def test_a_loss_that_is_over_before_the_limit_stops_nobody():
    assert found(injuries=[Injury("stop:mux", 0.5, 0.9)], turn=((2.0, 0.3),))[0] == ""


def test_of_two_losses_the_second_counts_if_it_came_before_rest_was_due():
    two = [Injury("stop:joy_node", 0.5, 2.0), Injury("stop:mux", 0.9, 2.0)]
    assert found(injuries=two, turn=((1.4, 0.3), (2.0, 0.0)))[0] == ""
    assert found(injuries=two[:1], turn=((1.4, 0.3), (2.0, 0.0)))[0] == "d"
    late = [two[0], Injury("stop:mux", 0.5 + LIMIT_S + DT, 2.0)]
    assert found(injuries=late, turn=((1.4, 0.3), (2.0, 0.0)))[0] == "d"


def test_a_lost_base_turns_no_wheels_that_anybody_sees():
    assert found(injuries=[Injury("stop:base", 0.5, 1.9)], turn=((2.0, 0.3),))[0] == ""


def test_late_packets_are_granted_their_time():
    hands, turn = ((0.0, "drive"), (1.0, "released")), ((1.9, 0.3), (2.5, 0.0))
    assert found(hands, [Injury("loss", 0.5, 1.5)], turn)[0] == ""
    assert found(hands, [Injury("duplication", 0.5, 1.5)], turn)[0] == "a"


def test_b_wheels_that_stood_turn_again_without_a_release():
    turn = ((0.5, 0.3), (0.8, 0.0), (1.5, 0.3))
    injury = [Injury("stop:mux", 0.3, 0.6)]
    assert found(injuries=injury, turn=turn)[0] == "b"
    again = ((0.0, "drive"), (0.6, "released"), (0.75, "drive"))
    assert found(again, injury, turn)[0] == ""


def test_a_release_before_the_stop_does_not_count():
    hands = ((0.0, "drive"), (0.1, "released"), (0.3, "drive"))
    turn = ((0.12, 0.3), (0.32, 0.0), (0.6, 0.3), (0.8, 0.0), (1.5, 0.3))
    assert found(hands, [Injury("stop:mux", 0.5, 0.6)], turn)[0] == "b"


def test_f_the_same_after_a_cut():
    turn = ((0.5, 0.3), (0.8, 0.0), (1.5, 0.3))
    assert found(injuries=[Injury("link_down", 0.3, 0.6)], turn=turn)[0] == "f"


@pytest.mark.parametrize("kind", [kind.name for kind in KINDS.values() if not kind.rearms])
def test_what_is_no_loss_asks_for_no_release(kind):
    turn = ((0.5, 0.3), (0.8, 0.0), (1.5, 0.3))
    assert found(injuries=[Injury(kind, 0.3, 0.6)], turn=turn)[0] == ""


def test_c_what_is_not_finite_or_beyond_the_limit():
    nan = Twist(0.5, (math.nan, 0.0, 0.0, 0.0, 0.0, 0.0))
    fast = Twist(0.5, (0.0, 0.0, 0.0, 0.0, 0.0, 2.1))
    assert found(turn=((1.0, 0.3),), commands=[nan])[0] == "c"
    assert found(turn=((1.0, 0.3),), asked=[fast])[0] == "c"
    assert found(turn=((1.0, 0.8),))[0] == "c"


def test_h_a_fault_elsewhere_stops_the_robot_or_its_odometry():
    injury = [Injury("hang_master", 0.3, 0.9)]
    assert found(injuries=injury, turn=((1.5, 0.3),))[0] == ""
    assert "h" in found(injuries=injury, turn=((0.5, 0.3), (1.5, 0.0)))[0]
    gap = [one for one in wheels((1.5, 0.3)) if not 0.5 < one.at_s < 0.9]
    record = Record([(0.0, "drive")], injury, gap)
    assert [v.invariant for v in judge(record).violations] == ["h"]


def test_h_not_where_another_fault_may_stop_it():
    two = [Injury("hang_master", 0.3, 0.9), Injury("stop:mux", 0.4, 1.5)]
    assert found(injuries=two, turn=((0.5, 0.3), (1.5, 0.0)))[0] == ""


def test_e_a_lower_input_drives_while_teleop_speaks():
    teleop = Twist(1.0, (0.3, 0.0, 0.0, 0.0, 0.0, 0.0))
    lower = Twist(1.5, (0.0, 0.1, 0.0, 0.0, 0.0, 0.0))
    assert found(turn=((2.0, 0.3),), commands=[teleop, lower])[0] == "e"
    assert found(turn=((2.0, 0.3),), commands=[teleop, lower._replace(at_s=2.1)])[0] == ""
    # A mux that was started anew has heard nobody.
    killed = [Injury("kill:mux", 1.1, 1.4)]
    assert found(injuries=killed, turn=((1.5, 0.3),), commands=[teleop, lower])[0] == ""


def test_of_each_invariant_the_first_violation_and_those_that_were_told():
    told = [Violation("g", 0.7, "did not end")]
    fast = [Twist(at_s, (1.0, 0.0, 0.0, 0.0, 0.0, 0.0)) for at_s in (0.5, 0.6)]
    assert found(turn=((1.0, 0.3),), commands=fast, told=told)[0] == "cg"
