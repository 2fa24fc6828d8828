"""The times of a robot's process, in s of wall time, each with its reason."""

IDLE_S = 0.25
"""Without a sight, until the host is looked for; also the longest wait for an answer of a program of lines, and between
two reports on hardware."""
CLAIM_REPLY_S = 4.0
"""For a reply to a claim: the host replies at once, or after the link of an earlier agent has expired."""
PROGRAM_SILENT_S = 1.0
"""Without an answer, until a program of lines counts as silent and may get a newer sight."""
PROGRAM_S = 30.0
"""For an answer of a program in a match in one process, which waits for each robot. For a program that is checked to
join, and for each of its commands: it may still load a model. For bwrap to start a program that does nothing, on a busy
machine."""
REPORT_S = 0.05
"""Between two lines without a command that are sent to the host, which limits a flood of them."""
PROGRAM_ENDS_S = 0.5
"""For a program to end after its input has ended, and again after SIGTERM; for a signal that has ended it to interrupt
this process, too, where it was sent to both."""
HANG_S = 10.0
"""For which a brain may be silent until its stack is reported, and in a planned match and in a check at all: a thousand
times what a decision takes. Also for it to be built where the match file allows less."""
