"""When the driver publishes: events join, and what stays the same is repeated."""

from hypothesis import given, settings
from hypothesis import strategies as st

from tutorial_testing.gamepad_events import AXIS, BUTTON, driver, events


def test_a_button_goes_out_at_once_and_takes_waiting_axes_along():
    ours = driver(autorepeat_rate=0)
    ours.read(events((AXIS, 0, -32767)), now=1.0)
    assert ours.read(events((BUTTON, 0, 1), (BUTTON, 0, 0)), now=1.0) == [
        ((1.0,), (1,)),
        ((1.0,), (0,)),
    ]
    assert ours.due == float("inf")


class Simulated:
    """A driver whose waits end on time. Times are whole numbers, so that their sums are exact."""

    def __init__(self, **parameters):
        self.driver = driver(deadzone=0.0, **parameters)
        self.now, self.sent = 0, 0
        self.untold = []  # when the changes were read that no message has shown yet
        self.ages = []  # of the oldest untold change, for each message

    def change(self, after, pressed=False):
        """After a time an axis changes to the number of changes so far, and maybe a button."""
        self.now += after
        while self.driver.due < self.now:
            due = self.driver.due
            self.published(self.driver.tick(due), due)
        self.sent += 1
        self.untold.append(self.now)
        new = [(AXIS, 0, self.sent)] + [(BUTTON, 0, self.sent % 2)] * pressed
        self.published(self.driver.read(events(*new), self.now), self.now)

    def published(self, messages, now):
        for axes, _ in messages:
            assert round(-axes[0] * 32767) == self.sent, "not the newest state"
            self.ages.append(now - min(self.untold, default=now))
            self.untold = []


@settings(max_examples=500)
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
