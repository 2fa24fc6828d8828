"""Wall times of recorders and replays, in s."""

HOST_ANSWER_S = 2.0
"""A request to a host that may be about to leave is repeated after this time."""
SETUP_FIRST_S, SETUP_LONGEST_S = 0.1, 1.6
"""Until the query for the setup is repeated: at first, and at most; the time doubles with each query."""
REPEAT_S = 0.2
"""Between a reply without a missing batch and the next request."""
QUIET_S = 0.5
"""Without a batch for this time, newer ones are requested: the last batch may have been lost."""
DRAINED_S = 0.25
"""At the end, without a message for this time, none is expected any more."""
REPORT_S = 0.05
"""Progress is reported, and the end of the match is looked for, after this time in any case."""
POLL_S = 0.2
"""Longest time between two polls: the file is written, or read as it grows, at least this often."""
RECOVERY_POLL_S = 0.01
"""Between two polls while batches are missing; shortest wait of a writer for what is to be written."""
FLUSH_S = 0.5
"""Messages are in the file after this time."""
LATCHED_S = 1.0
"""A paused replay publishes the latched messages again after this time, for new listeners."""
REPLAY_STEP_S = 0.001
"""Shortest time between two checks of a replay for queries and due messages."""
RECORDER_PATIENCE_S = 1.0
"""A replay no longer waits for a recorder without progress for this time."""
