"""The times of commands, launcher and planned matches, in s of wall time, each with its reason."""

POLL_S = 0.05
"""Between two looks at the processes of a match and at its bus: two and a half ticks."""
WATCH_S = 0.01
"""Between two looks for something that comes or ends at any moment, such as a host that starts."""
PAGE_CLOSES_S = 1.0
"""After which the server of a page ends if it has a result and no page is open."""
BUILD_NOTICE_S = 3.0
"""After which a wait for brains that are built is reported."""
HANG_S = 10.0
"""For which a brain may be silent in a planned match, a thousand times what a decision takes, and for it to be built
where the match file allows less."""
HANG_RENEW_S = 0.25
"""Between two renewals of the deadline of a brain: each starts a thread."""
EXAMINE_S = 2.0
"""For one connection or handshake that is examined, and for which a host is heard then: eight of its reports."""
PROGRAM_S = 30.0
"""For a program that is checked to join, and for each of its commands: it may still load a model. For bwrap to start a
program that does nothing, on a busy machine."""
PROGRAM_ENDS_S = 1.5
"""From SIGTERM to SIGKILL for robots, page and bridges after a match, and for a program that is checked."""
REFRESH_S = 0.1
"""Between two states of what is shown on a terminal."""
STATUS_S = 5
"""Between two lines of status on a stream that is no terminal, and two looks of a page at a cup that is running."""
