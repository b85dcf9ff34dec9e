"""A cable between two hosts that loses, delays, doubles and reorders: two TUN devices, and this.

    relay.py SEED NAME_OF_THE_FIRST NAME_OF_THE_SECOND

It reads lines `link_down|loss|delay|duplication|reordering|throttle VALUE`; 0: nothing of it. A
kernel may have no netem; a TUN device is found everywhere.
"""

import fcntl
import heapq
import os
import random
import select
import struct
import sys
import time

_TUNSETIFF = 0x400454CA
_IFF_TUN, _IFF_NO_PI = 0x0001, 0x1000
_LARGEST_PACKET = 65536
# What a slow radio link keeps for later, at most [bytes]; what comes then is lost.
LONGEST_QUEUE = 3000
ILLS = ("link_down", "loss", "delay", "duplication", "reordering", "throttle")


def open_tun(name):
    """Return the file of a new network device, packets without a header."""
    fd = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(fd, _TUNSETIFF, struct.pack("16sH22x", name.encode(), _IFF_TUN | _IFF_NO_PI))
    return fd


class Cable:
    """Decides what becomes of packets (pure: time and chance enter from outside)."""

    def __init__(self, chance):
        """chance: a random.Random."""
        self._chance = chance
        self._free_s = {}  # from an end to when its slow link has sent all it has
        self.ills = dict.fromkeys(ILLS, 0.0)

    def sends(self, end, size, now):
        """Return when a packet, which left an end at a time [s], arrives: [time], [] or twice."""
        ills, chance = self.ills, self._chance.random
        if ills["link_down"] or chance() < ills["loss"]:
            return []
        at_s = now + ills["delay"]
        if ills["throttle"]:  # [bytes/s]
            at_s = max(at_s, self._free_s.get(end, now)) + size / ills["throttle"]
            if (at_s - now) * ills["throttle"] > LONGEST_QUEUE:
                return []
            self._free_s[end] = at_s
        if chance() < ills["reordering"]:
            at_s += 0.05
        return [at_s, at_s + 0.001] if chance() < ills["duplication"] else [at_s]


def main():
    """Relay until the standard input ends."""
    seed, *names = sys.argv[1:]
    ends = [open_tun(name) for name in names]
    cable, queue, number = Cable(random.Random(seed)), [], 0
    print("ready", flush=True)
    while True:
        wait_s = max(0.0, queue[0][0] - time.monotonic()) if queue else None
        readable, _, _ = select.select([sys.stdin, *ends], (), (), wait_s)
        now = time.monotonic()
        if sys.stdin in readable:
            line = os.read(sys.stdin.fileno(), 4096).decode()
            if not line:
                return
            for ill, value in map(str.split, line.splitlines()):
                cable.ills[ill] = float(value)
            if cable.ills["link_down"]:
                queue = []  # what was on its way is lost
        for end in [end for end in ends if end in readable]:
            packet = os.read(end, _LARGEST_PACKET)
            for at_s in cable.sends(end, len(packet), now):
                number += 1
                heapq.heappush(queue, (at_s, number, ends[end == ends[0]], packet))
        while queue and queue[0][0] <= now:
            _, _, end, packet = heapq.heappop(queue)
            try:
                os.write(end, packet)
            except OSError:
                pass  # its host is gone, or has taken the device down


if __name__ == "__main__":
    main()
