"""The times of commands, launcher and planned matches, in s of wall time, each with its reason."""

POLL_S = 0.05
"""Between two looks at the processes of a match and at its bus: two and a half ticks."""
WATCH_S = 0.01
"""Between two looks for something that comes or ends at any moment, such as a host that starts."""
LAST_MESSAGES_S = 5.0
"""For the host's last messages after its process has ended: the link closes with them, but a busy machine is late."""
PAGE_CLOSES_S = 1.0
"""After which the server of a page ends if it has a result and no page is open."""
BUILD_NOTICE_S = 3.0
"""After which a wait for brains that are built is reported."""
BUILD_S = 10.0
"""For a brain to be built where the match file allows less."""
DASK_CONNECT_S = 10.0
"""To reach a Dask scheduler on another machine."""
HANG_S = 10.0
"""For which a brain may be silent in a planned match: a thousand times what a decision takes."""
HANG_RENEW_S = 0.25
"""Between two renewals of the deadline of a brain: each starts a thread."""
BUBBLEWRAP_S = 20.0
"""For bwrap to start a program that does nothing, on a busy machine."""
HOST_S = 3.0
"""For a host that runs to answer a command."""
CONNECT_S = 2.0
"""For one connection or handshake that is examined."""
LISTEN_S = 1.5
"""For which a host is heard when the way to it is examined: six of its reports."""
ORDER_S = 2.0
"""For the robots to acknowledge an order, where the command does not say."""
PROGRAM_S = 30.0
"""For a program that is checked to join, and for each of its commands: it may still load a model."""
PROGRAM_ENDS_S = 1.5
"""From SIGTERM to SIGKILL for a program that is checked, as in a match."""
REFRESH_S = 0.1
"""Between two states of what is shown on a terminal."""
LINE_S = 5.0
"""Between two lines of status on a stream that is no terminal."""
ATTENDANCE_S = 86_400.0
"""For which a host on its own waits for its robots, which people start on other machines."""
