"""The log of the league's referee box: the world states of both teams, and the signals of the referee.

Its files are `<time>.A.msl` and `<time>.B.msl`, arrays of the teams' world states, and `<time>.msl`, one line for each
signal; usually all in one zip. Team A is cyan. `schemas.messages.soccer.league` defines the signals and the axes.
"""

LOG_PERIOD = 0.04
"""s between two world states. Chosen here: the league requires at least 10 Hz; teams' programs run at 25 to 30 Hz."""
IMPORTER = "import"
"""Name of the recorder in the manifest of an import, whose kicks are inferred."""
