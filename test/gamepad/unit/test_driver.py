"""The driver without ROS and without a device: bytes and times in, axes and buttons out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gamepad.driver.driver import LONGEST_LIFELESS_S, SHORTEST_SILENCE_S
from gamepad.driver.parameters import DriverParameters
from gamepad.driver.report import SILENT_FOR, DriverReport
from gamepad.driver.schedule import Schedule
from gamepad.js_event import SIGN_OF_LIFE_MS
from tutorial_testing.claims import claim
from tutorial_testing.gamepad_events import AXIS, BUTTON, INIT, driver, events, sign

INF = float("inf")


def test_the_state_sent_again_after_an_overrun_counts_for_a_kernel_device():
    burst = events((AXIS | INIT, 0, 5), (AXIS, 0, -32767), (AXIS | INIT, 0, 0))
    for kernel_device, axis in ((True, 0.0), (False, 1.0)):
        ours = driver(kernel_device)
        ours.read(burst, 0.0)
        assert ours.tick(0.001) == [((axis,), ())]


PUSHED = ((AXIS, 5, 32767), (AXIS, 1, -32767), (BUTTON, 4, 1))


@pytest.mark.parametrize(
    ("how", "sent", "neutral"),
    [
        ({"triggers": (2, 5)}, PUSHED, ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0), (0,) * 5)),
        # A gamepad whose triggers are unknown.
        ({"triggers": None}, PUSHED, ((0.0,) * 6, (0,) * 5)),
        ({"triggers": None, "kernel_device": False}, ((AXIS, 7, 32767), *PUSHED),
         ((0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), (0,) * 5)),
    ],
)  # fmt: skip
def test_a_lost_gamepad_gives_one_neutral_message_with_released_triggers(how, sent, neutral):
    ours = driver(**how)
    ours.read(events(*sent), now=0.0)
    assert ours.lost(0.1) == [neutral]
    assert ours.due == INF
    assert ours.lost(0.2) == driver().lost(0.2) == []  # nothing to report


@claim("After a loss it publishes one neutral message, then nothing until the gamepad is touched")
def test_after_a_loss_it_is_silent_until_the_user_touches_the_gamepad():
    assert 0.5 < SHORTEST_SILENCE_S < 1.0  # longer than joy2twist's ~joy_timeout
    ours = driver(sticky_buttons=True)
    assert ours.opens_at == -INF
    ours.read(events((BUTTON, 4, 1)), now=0.0)
    ours.lost(1.0)
    assert ours.opens_at == 1.0 + SHORTEST_SILENCE_S
    untouched = events((BUTTON | INIT, 4, 0), (AXIS | INIT, 0, 0))
    for now in (2.0, 4.0):  # lost again before it was touched: nothing to release
        ours.opened((), kernel_device=True)
        assert ours.read(untouched, now) == []
        assert ours.due == INF
        assert ours.tick(now + 1.0) == []
        assert ours.lost(now + 1.0) == []
    ours.opened((), kernel_device=True)
    ours.read(untouched, now=6.0)
    # The loss released a sticky button that was on.
    assert ours.read(events((BUTTON, 4, 1)), now=6.1) == [((0.0,), (0, 0, 0, 0, 1))]


STATE = ((BUTTON, 4, 1), (AXIS, 1, -32767))
ALIVE = [(events(*STATE), 0.9), (sign(*STATE), 1.0)]
KERNEL, FIFO = True, False


@claim("A source that owes signs of life is lost without them")
@pytest.mark.parametrize(
    ("about", "kernel_device", "read", "last_sign"),
    [
        ("signs that end", FIFO, ALIVE, 1.0),
        # A lost byte turns all that follows into noise, which is no sign of life.
        ("noise is no sign", FIFO, [*ALIVE, (b"?" + sign(*STATE), 1.2), (events(STATE[1]), 1.3)],
         1.0),
        # As after opening the source in the middle of an event.
        ("noise before any sign", FIFO, [(b"???" + sign(*STATE), 1.0), (sign(*STATE), 1.3)], 1.0),
        ("a source that never gave a sign", FIFO, [(events(*STATE), 1.0)], INF),
        ("a change at the time of a sign", FIFO,
         [(events((BUTTON, 0, 1), time_ms=SIGN_OF_LIFE_MS), 1.0)], INF),
        ("the kernel gives no signs, whatever its clock shows", KERNEL, ALIVE, INF),
    ],
)  # fmt: skip
def test_a_source_that_owes_signs_of_life_is_lifeless(about, kernel_device, read, last_sign):
    assert 0.3 < LONGEST_LIFELESS_S < 0.5  # two signs of virtual_joystick; joy2twist's ~joy_timeout
    ours = driver(kernel_device, autorepeat_rate=0)
    for data, now in read:
        ours.read(data, now)
        ours.tick(now + 0.01)
    assert not ours.is_lifeless(min(1e9, last_sign + LONGEST_LIFELESS_S - 0.01)), about
    assert ours.is_lifeless(1e10) is (last_sign < INF)
    assert not last_sign < INF or ours.is_lifeless(last_sign + LONGEST_LIFELESS_S)
    assert ours.due == last_sign + LONGEST_LIFELESS_S
    ours.lost(2.0)
    assert not ours.is_lifeless(1e9)
    ours.opened((), kernel_device)
    assert not ours.is_lifeless(1e9)


def test_a_sign_publishes_nothing_and_moves_nothing():
    ours = driver(FIFO, autorepeat_rate=0)
    for data, now in ALIVE:
        ours.read(data, now)
        ours.tick(now + 0.05)
    assert ours.read(sign((BUTTON, 4, 0), (AXIS, 1, 0)), 1.1) == []
    assert ours.tick(1.2) == []
    data = sign(*STATE) + events((BUTTON, 0, 1)) + sign(*STATE)  # a change between signs
    ((axes, buttons),) = ours.read(data, 1.3)
    assert (axes[1], buttons) == (pytest.approx(1.0), (1, 0, 0, 0, 1))


def test_a_report_has_the_rates_and_a_change_is_reported_at_once():
    report, pad = DriverReport(DriverParameters(), "/joy"), driver()
    assert report.published == 0 and report.due(-1.0) and not report.due(-0.1)
    report.opened("/dev/input/js1", "Pad")
    for now, presses, rates in ((10.0, 5, (0.0, 0.0)), (12.0, 3, (1.5, 3.0)), (12.0, 0, (0, 0))):
        pad.read(events(*[(BUTTON, 0, 1)] * presses), now - 8.0)
        report.published += 2 * presses
        details = dict(report.details(pad, 1, now))
        names = [f"recent {what} rate (Hz)" for what in ("joystick event", "publication")]
        assert (*(details[name] for name in names), details[SILENT_FOR]) == (*rates, "8.0")
    assert report.due(12.0) and not report.due(12.9) and report.due(13.0) and report.summary()[0]
    report.lost()
    assert report.due(-2.0) and report.summary() == (False, "Joystick not open.")


class Simulated:
    """A driver whose waits end on time. Times are whole numbers, so that their sums are exact."""

    def __init__(self, **parameters):
        self.driver = driver(deadzone=0.0, **parameters)
        self.now, self.sent = 0, 0
        self.untold = []  # the times of changes that no message has published yet
        self.ages = []  # age of the oldest unsent change, per message

    def change(self, after, pressed=False):
        """Let time pass, then set an axis to the number of changes so far, and maybe a button."""
        self.now += after
        while self.driver.due < self.now:
            due = self.driver.due
            self.published(self.driver.tick(due), due)
        self.sent += 1
        self.untold.append(self.now)
        new = [(AXIS, 0, self.sent)] + [(BUTTON, 0, self.sent % 2)] * pressed
        self.published(self.driver.read(events(*new), self.now), self.now)
        assert not (pressed and self.untold), "a button that waits"

    def published(self, messages, now):
        for axes, _ in messages:
            assert round(-axes[0] * 32767) == self.sent, "not the newest state"
            self.ages.append(now - min(self.untold, default=now))
            self.untold = []


@claim("A burst is coalesced, and a still stick hardly wakes the driver", because="bursts")
@given(
    st.lists(st.tuples(st.integers(0, 30), st.booleans()), max_size=60),
    st.integers(0, 20),
    st.sampled_from((0, 1 / 4, 1 / 32)),
)
def test_every_message_tells_the_newest_state_and_none_is_older_than_the_interval(
    changes, interval, autorepeat_rate
):
    simulated = Simulated(coalesce_interval=interval, autorepeat_rate=autorepeat_rate)
    for change in changes:
        simulated.change(*change)
        assert all(age <= interval for age in simulated.ages)
        assert simulated.driver.due <= min(simulated.untold, default=float("inf")) + interval


@pytest.mark.parametrize(("rate", "due"), [(0.5, 3.0), (4, 1.25), (0, INF)])
def test_the_repetition_may_be_slow_or_off(rate, due):
    schedule = Schedule(0.001, rate)
    schedule.published(1.0)
    assert schedule.due == due
