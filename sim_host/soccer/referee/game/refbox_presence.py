"""Whether a league's referee box officiates: while it is connected, and for some time after it has gone.

The time bridges a link that breaks and is made again: a half whose time is up shall not end because of it.
"""

GRACE_S = 10.0
"""s of simulated time (ours); a base station that has lost its box tries again after 5 s of wall time at most."""


def refbox_gone_after(gone: float | None, connected: bool, dt: float) -> float | None:
    """s for which the box has been gone, `dt` s later; 0 while it is connected, None once its time is over."""
    if connected:
        return 0.0
    if gone is None or gone + dt >= GRACE_S:
        return None
    return gone + dt
