"""The log of the league's referee box: what both teams said of the world, and what the referee signalled.

Its files: `<time>.A.msl` and `<time>.B.msl`, arrays of the teams' world states, and `<time>.msl`, one line for each
signal; all in one zip (RefBox 2). Team A is cyan. Signals and axes are defined in `schemas.league`.
"""

LOG_PERIOD = 0.04
"""s between two world states. Ours: the league asks for at least ten a second; teams' programs think at 25 to 30 Hz."""
