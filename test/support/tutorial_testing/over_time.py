"""What a Safety sends while time passes and no message arrives."""


def over_time(machine, start, end, step=0.01):
    """Call tick() when it is due and at every step; return the (time, velocity) that it sends."""
    sent, now = [], start
    while now < end:
        velocity = machine.tick(now)
        if velocity is not None:
            sent.append((round(now, 6), velocity))
        now = min(max(machine.due, now + 1e-9), now + step)
    return sent
