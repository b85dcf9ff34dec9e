"""Which connection or page is closed when all places are taken (pure)."""

from collections import Counter
from typing import List, Optional, Sequence, Tuple, TypeVar

from cockpit_server.access import DRIVER
from cockpit_server.clients import Client

IDLE_S = 60.0  # a viewer that asked for nothing for so long gives way to one of its own address

T = TypeVar("T")


def of_the_fullest(present: Sequence[Tuple[T, str]]) -> List[T]:
    """Return the entries of the address that has most of them. present: (entry, address)."""
    counts = Counter(address for _, address in present)
    most = max(counts.values(), default=None)
    return [one for one, address in present if counts[address] == most]


def connection_to_close(unused: Sequence[Tuple[T, str]]) -> Optional[T]:
    """Return the connection to close for a new one, or None.

    unused: (connection, address) of those that belong to no page, the oldest first. A browser's
    request takes milliseconds: an old connection asks for nothing.
    """
    return next(iter(of_the_fullest(unused)), None)


def page_to_close(pages: Sequence[Client], role: str, address: str, now: float) -> Optional[Client]:
    """Return the viewer to close for a new page, or None if the new page is to be refused.

    A driver replaces the idlest viewer of the address that has most. A viewer does so if that
    address has more than its own would then have, or else replaces a viewer of its own address that
    is idle: many people may share one address (NAT).
    """
    viewers = [page for page in pages if not page.drives]
    fullest = of_the_fullest([(page, page.address) for page in viewers])
    own = [page for page in viewers if page.address == address]
    if fullest and (role == DRIVER or len(fullest) > len(own) + 1):
        return min(fullest, key=lambda page: page.spoke_at)
    idlest = min(own, key=lambda page: page.spoke_at, default=None)
    return idlest if idlest and now - idlest.spoke_at > IDLE_S else None
