"""How far a host may run ahead of its recorders, what it keeps for them, and for how long readers request it.

These numbers have to agree.

A lockstep host waits for a stalled recorder when it is `RUN_AHEAD_TICKS` ahead of it, so that everything that the
recorder missed is in the `KEPT_BATCHES`. A host does not wait for a recorder that works: the data that it reads at
once, and the ticks between two of its reports, are a fraction of that.
"""

BATCH_TICKS = 8
"""Ticks in a batch: with five robots a side, a batch fits into one of Zenoh's batches of 64 KiB; more is split."""
BATCH_S = 0.15
"""A record batch with fewer ticks is published after this s of wall time; a recorder has it half a second later."""
KEPT_BATCHES = 300
"""Batches that a host keeps, of at most `BATCH_TICKS` each: 2400 ticks, 48 s in real time."""
KEPT_BYTES = 64 * 2**20
"""Most bytes of all batches that a host keeps; above this it keeps fewer batches."""
RUN_AHEAD_TICKS = 250
"""Most ticks that a lockstep host or a replay is ahead of a recorder."""
REST_TICKS = 60
"""Most ticks between two polls of a recorder."""
REPORT_TICKS = 25
"""Ticks after which a recorder reports its progress at once."""
