"""The times of the gateway, in s of wall time, each with its reason."""

POLL_S = 0.01
"""Between two polls of the bus, or of who is due: half a tick of the host."""
HOST_RETRY_S = 0.5
"""One attempt to find a host, which is how soon a signal ends the process; until one that did not reply is queried
again."""
STATE_SETTLES_S = 0.2
"""Without another state, the last one is the newest: a host's cache may deliver the oldest first."""
CATCH_UP_S = 1.0
"""A state that was published before a reply may arrive after it, by at most this."""

FRAME_S = 0.04
"""Between two frames for pages: people see no more than 25 a second."""
STATUS_S = 0.2
"""Between two queries of a replay's status, and two looks for the result of a match."""
PAGE_ALIVE_S = 0.5
"""Between two signs of life to pages; a page shows a silent connection after 1.4 s."""
RELOAD_S = 3.0
"""A page that was closed may come again, as one does that is loaded anew."""
CLIENT_S = 1
"""For what a client sends first of all: the token of a page that comes when all places are taken, the name of a base
station; some base stations wait for the welcome before they send anything. To tell a page why it is closed, and for
responses that are in progress when the server ends: a client may read nothing."""

UNREAD_S = 10.0
"""A connection is closed whose other side has read nothing for this long: of pages, and to a referee box."""
SILENCE_S = 5.0
"""A coach program's session is over, and a base station is no longer in use, when nothing is received for this long. An
attempt to connect to a referee box takes at most this, and so does the longest pause between two."""

BOX_PERIOD_S = 0.05
"""Between two world states to a referee box, and two datagrams of the audience feed. The league's box sends the feed as
often; it requires ten world states a second."""
BOX_FIRST_PAUSE_S = 0.25
"""Between two attempts to connect to a referee box, doubled each time. After a link on which the box has sent
something, the first pause applies again."""
START_AGAIN_S = 0.1
"""Between two repetitions of START."""
WORLD_STATE_S = 1.0
"""A base station's world state is replaced by ours in the audience feed when it is older."""
