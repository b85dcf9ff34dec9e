"""The kinds of faults that a trial may have, and what is promised under each (pure)."""

from dataclasses import dataclass
from typing import Dict, Tuple

DRIVER, JOY2TWIST, MUX, BASE = "joy_node", "joy2twist", "mux", "base"
NODES = (DRIVER, JOY2TWIST, MUX, BASE)

# What a kind needs of the machine.
LINK, MOUNT, SIMULATED = "network namespaces", "mounting", "simulated time"

# A sender that fell silent for longer must rest before it moves the robot again (the mux's
# REARM_S): so late may a packet come that TCP sends once more, and still count.
RESENT_S = 0.5
VIGILANCE_S = (
    1.0  # joy2twist's ~vigilance_timeout here: shorter than in launch files, for more trials
)


@dataclass(frozen=True)
class Kind:
    """A kind of fault.

    lasts_s: the shortest and the longest time [s]. loses: whether a part is lost meanwhile, so that
    the wheels must be at rest in time. goes_on: whether the robot must be driven on all the while.
    late_s: what it may add to the time until the wheels are at rest [s]. rearms: whether a robot
    that stood must wait for the release. needs: LINK, MOUNT or SIMULATED, "" for nothing.
    """

    name: str
    lasts_s: Tuple[float, float]
    loses: bool = False
    goes_on: bool = False
    late_s: float = 0.0
    rearms: bool = True
    needs: str = ""

    @property
    def family(self):
        """The kind without the part that it hits."""
        return self.name.split(":")[0]

    @property
    def part(self):
        """The part that it hits, or ""."""
        return self.name.partition(":")[2]


def _kinds():
    for node in NODES:
        yield Kind(f"kill:{node}", (0.05, 0.7), loses=True)
        yield Kind(f"stop:{node}", (0.02, 1.5), loses=True)
        yield Kind(f"end:{node}", (0.05, 0.7), loses=True)
    yield Kind("unplug", (0.02, 1.2), loses=True)
    yield Kind("frozen_pad", (0.7, 1.5), loses=True)
    # Out of reach: the receiver keeps the last state, and only joy2twist can notice.
    yield Kind("radio_silence", (0.1, 2.5), loses=True, late_s=VIGILANCE_S)
    yield Kind("second_joystick", (0.1, 1.0))
    # A bad message stops until the next good one, as joy2twist's README has it: no loss.
    yield Kind("nan_joy", (0.1, 1.0), rearms=False)
    yield Kind("broken_joy", (0.1, 1.0), rearms=False)
    yield Kind("kill_master", (0.1, 1.0), goes_on=True)
    yield Kind("hang_master", (0.1, 1.5), goes_on=True)
    for topic in ("teleop", "navi", "cmd_vel"):
        yield Kind(f"nan_command:{topic}", (0.1, 1.0), goes_on=True)
        yield Kind(f"broken_command:{topic}", (0.1, 1.0), goes_on=True)
    yield Kind("lower_input", (0.1, 1.0), goes_on=True)
    yield Kind("stopped_viewer", (0.1, 1.5), goes_on=True)
    yield Kind("slow_viewer", (0.1, 1.5), goes_on=True)
    yield Kind("silent_peer", (0.1, 1.5), goes_on=True)
    yield Kind("busy_machine", (0.3, 1.5))
    yield Kind("little_memory", (0.3, 1.5), goes_on=True)
    yield Kind("full_disk", (0.3, 1.5), goes_on=True, needs=MOUNT)
    yield Kind("link_down", (0.05, 1.5), loses=True, needs=LINK)
    yield Kind("loss", (0.3, 1.5), late_s=RESENT_S, needs=LINK)
    yield Kind("delay", (0.3, 1.5), late_s=RESENT_S, needs=LINK)
    yield Kind("duplication", (0.3, 1.5), needs=LINK)
    yield Kind("reordering", (0.3, 1.5), late_s=RESENT_S, needs=LINK)
    yield Kind("throttle", (0.3, 1.5), late_s=RESENT_S, needs=LINK)
    # Simulated time that stands still or jumps stops no joystick.
    yield Kind("clock_forward", (0.1, 0.3), rearms=False, needs=SIMULATED)
    yield Kind("clock_back", (0.1, 0.3), rearms=False, needs=SIMULATED)
    yield Kind("clock_pause", (0.1, 0.8), rearms=False, late_s=0.8, needs=SIMULATED)


KINDS: Dict[str, Kind] = {kind.name: kind for kind in _kinds()}


def chosen(words, granted):
    """The names of the kinds of a command line; all of them if there are no words.

    words: names of kinds, or of families such as kill. granted: those of LINK, MOUNT, SIMULATED
    that there are. Raises ValueError for a word that is none.
    """
    for word in words:
        if not any(word in (kind.name, kind.family) for kind in KINDS.values()):
            families = sorted({kind.family for kind in KINDS.values()})
            raise ValueError(f"{word}: is no kind of fault; there are {', '.join(families)}")
    return [
        kind.name
        for kind in KINDS.values()
        if (not words or kind.name in words or kind.family in words)
        and (not kind.needs or kind.needs in granted)
    ]
