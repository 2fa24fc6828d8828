"""Wall times of the host, in s."""

from runtime.process.timing import HEARTBEAT_S

QUICK_S = 0.1
"""A late answer with a shorter latency was late for its tick, not for the time that the agent took."""
RESEND_S = 0.05
"""An unanswered sight is sent again after this time: its command may have been lost."""
PRESENCE_S = 0.005
"""Between two checks for agents that have joined or left, and at the end for recorders that have read all."""
HEALTH_S = 0.25
"""Between two reports on health, and two updates of the accounts' limits."""
AVERAGING_S = 1.0
"""The real-time factor is averaged over this time."""
FULL_TIME_GRACE_S = 1.5 * HEARTBEAT_S
"""The host stays for its watchers after full time: missed messages of the end show with the bus's next heartbeat, and
can be fetched as long as the host is running."""
