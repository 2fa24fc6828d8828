"""The times of commands, launcher and planned matches, in s of wall time, each with its reason."""

POLL_S = 0.05
"""Between two looks at the processes of a match and at its bus: two and a half ticks."""
PAGE_CLOSES_S = 1.0
"""After which the server of a page ends if it has a result and no page is open."""
HANG_RENEW_S = 0.25
"""Between two renewals of the deadline of a brain: each starts a thread."""
PROGRAM_ENDS_S = 1.5
"""From SIGTERM to SIGKILL for robots, page and bridges after a match, for an interrupted recorder, and for a program
that is checked."""
HOST_ENDS_S = 0.2
"""For an interrupted host to end after its tick, and again for robots, page and bridges; then the recorder is told."""
REFRESH_S = 0.1
"""Between two states of what is shown on a terminal."""
STATUS_S = 5
"""Between two lines of status on a stream that is no terminal, and two looks of a page at a cup that is running. A wait
for brains that are built is reported after it."""
