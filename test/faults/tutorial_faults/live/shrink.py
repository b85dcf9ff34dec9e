"""The shortest list of faults that still breaks an invariant (pure)."""

TRIES = 3  # of each shorter list: what is random in the nodes and the machine may spare it once


def shrink(plan, breaks, tries=TRIES):
    """The smallest Plan found that still breaks an invariant.

    breaks: tells whether a Plan does, by trying it. Faults are left out one by one, then the hands
    made to hold on, as long as anything can be.
    """
    smaller = True
    while smaller:
        smaller = False
        shorter = [plan.without(number) for number in range(len(plan.faults))]
        if plan.hands != plan.holding().hands:
            shorter.append(plan.holding())
        for candidate in shorter:
            if any(breaks(candidate) for _ in range(tries)):
                plan, smaller = candidate, True
                break
    return plan
