"""How far a host runs ahead of its recorders, and what it keeps for them: numbers that have to agree.

A lockstep host waits for a recorder that stands still when it is `RUN_AHEAD_TICKS` ahead of it, so that everything the
recorder missed is among the `KEPT_BATCHES`. No host waits for a recorder that works: what it reads at once, and the
ticks between two of its reports, are a fraction of that.
"""

BATCH_TICKS = 8
"""Ticks of a batch: of five a side a batch fits into one of Zenoh's, 64 KiB."""
BATCH_S = 0.15
"""Wall time after which a batch of fewer ticks is published: half a second later a recorder has it on its disk."""
KEPT_BATCHES = 300
"""Batches that a host keeps, of at most `BATCH_TICKS` each: 2400 ticks, which are 48 s in real time."""
KEPT_BYTES = 64 * 2**20
"""Bytes of all batches that a host keeps; above them it keeps fewer batches."""
RUN_AHEAD_TICKS = 250
"""Ticks that a lockstep host, or a replay, is at most ahead of a recorder."""
REST_TICKS = 60
"""Ticks that may pass between two looks of a recorder."""
REPORT_TICKS = 25
"""Ticks after which a recorder reports its progress at once."""
PARTING_S = 5.0
"""Wall time that a host, or a replay, waits at its end for its recorders to take in the last tick."""
