"""Commands sent during a suspension are ignored."""

from node_kit.rules.arming import SETTLING_S, Resumption


def test_what_a_receiver_obeys_after_suspensions():
    resumption = Resumption()
    assert SETTLING_S == 0.25  # less than joy2twist's ~joy_timeout, more than a full socket takes
    steps = [  # (now, number of suspensions, new, old)
        (5.0, 0, False, False),
        (6.0, 3, True, True),
        (6.1, 3, False, True),
        (6.25, 3, False, False),
        (7.0, 1, True, True),  # any other number counts as new
    ]
    for now, number, new, old in steps:
        assert resumption.notice(number, now) is new, now
        assert resumption.is_old(now) is old, now
