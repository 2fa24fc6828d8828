"""Wall times of the bus and of processes, in s unless the name says otherwise."""

LEASE_S = 2.0
"""Without any data for this time, a link counts as broken, and a half-open connection makes room."""
HEARTBEAT_S = 0.5
"""Longest time until a subscriber of a `recovered` topic detects that it missed the newest message."""
LINK_GRACE_S = LEASE_S + 0.5
"""Watchers tolerate a broken link for this time, and a claim waits for the end of an earlier agent."""
RECONNECT_S = 10.0
"""An unreachable host or scheduler is waited for this long; agents and recorders then give up the match. A host that is
present has this time to answer a recorder; one that has left may have sent messages for it: one that continues would
never end. A client that waits for its host says so again after it."""
CUT_OFF_S = 3600.0
"""The same where the network to the host is cut: the match goes on there, and lasts no longer."""
POLL_S = 0.02
"""Between two checks for what may come or end at any moment: a host, a robot, a process. Longest time between two
checks of a replay for queries and due messages."""
PROBE_EVERY_S = 1.0
"""Between two checks whether the network is cut."""
PROBE_S = 0.3
"""A machine that does not answer a probe for this time is cut off: its clients have nothing else to do meanwhile."""
REPLY_S = 1.0
"""For a reply: of a router to a query for tokens, of a host to a robot's query for the setup or a recorder's query for
batches, of a machine to a connection that shows why no host admits a client. It is longer than one packet that is lost
and sent again takes. A recorder whose host has failed has received all by then."""
REQUEST_S = 3.0
"""For a reply of a host, or of robots to an order, to what a person requests: a busy host replies between two ticks. A
recorder without its match reports that after this time; a link and a host are examined for it."""
SLICE_S = 0.2
"""A client that waits for a host asks again after this time, and whether it is to stop."""
WAKE_AGAIN_S = 0.05
"""A reader that was woken and still waits is woken again."""
FIRST_ATTEMPT_S = 0.5
"""Length of the first attempt to connect; it doubles with each attempt, up to `LEASE_S`: a machine may be too busy to
answer at once. Ctrl-C takes effect between attempts."""
HANDSHAKE_S = 0.9
"""Longest attempt to connect again. A cut network answers nothing, and an attempt that has begun then repeats its
packets ever more rarely: only a new attempt notices at once that the network is back. It suffices for the handshake of
four round trips at 0.1 s of delay each way."""
RETRY_FROM_MS, RETRY_TO_MS = 20, 100
"""Between two attempts to connect again, which becomes longer; between the first ones of a client, the longest."""
CONGESTION_US = 1_000_000
"""A client has to make room for data that must not be dropped within this time; then its link is closed, and it may
connect again."""
GIVE_UP_S = 20.0
"""Without progress for this time, missing batches are given up; a link recovers in less."""
PARTING_S = 5.0
"""For the last messages of a match: a host or a replay waits at its end for recorders, a host longer for those that it
admitted; a launcher for the messages of a host whose process has ended, since a busy machine is late. A recorder of
keys that is stopped writes what has arrived before for so long at most."""
SUSPENDED_S = 0.5
"""Most time between two readings of a clock that counts; the rest is taken for a suspension of the process."""
CORE_WAIT_S = 0.25
"""Longest time that a step in idle time may wait for a core; with a dozen processes of a match on two cores it waits a
tenth of that."""
IDLE_AGAIN_S = 30.0
"""Idle time is tried again on a machine that was busy."""
