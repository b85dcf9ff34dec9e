"""Who has to go when there is no more room, so that nobody locks out all others (pure)."""

from collections import Counter
from typing import List, Optional, Sequence, Tuple, TypeVar

from cockpit_server.access import DRIVER

T = TypeVar("T")


def of_the_fullest(present: Sequence[Tuple[T, str]]) -> List[T]:
    """Return what comes from the address that has the most. present: (what is there, address)."""
    counts = Counter(address for _, address in present)
    most = max(counts.values(), default=0)
    return [one for one, address in present if counts[address] == most]


def connection_to_close(unused: Sequence[Tuple[T, str]]) -> Optional[T]:
    """Return the one that has to go for a new connection, None if there is none.

    unused: (connection, address) of those that are no page's, the oldest first. A browser's are
    through in milliseconds: what is old asks for nothing.
    """
    return next(iter(of_the_fullest(unused)), None)


def page_to_close(pages: Sequence[Tuple[T, str, str]], role: str, address: str) -> Optional[T]:
    """Return the viewer that has to go for a new page, None if the new one is to be refused.

    pages: (page, role, address), the oldest first. Who may drive comes in as long as anybody only
    looks; a viewer, if another address has more of them than its own would then have.
    """
    viewers = [(page, its) for page, its_role, its in pages if its_role != DRIVER]
    fullest = of_the_fullest(viewers)
    own = sum(its == address for _, its in viewers)
    if not fullest or (role != DRIVER and len(fullest) <= own + 1):
        return None
    return fullest[-1]
