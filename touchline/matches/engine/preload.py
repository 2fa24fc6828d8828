"""What the fork server of matches has in memory before it forks: the modules of a match, and what they keep once made.

The fork server imports this module once; a match then loads its world and its brains alone. Modules of a team's own are
imported in the process of its match, never here. Nothing here starts threads or draws random numbers: a fork would have
no such threads, and the same numbers as its siblings.
"""

import gc

from schemas.config.match_config import MatchConfig
from touchline.matches.engine import verify as verify
from touchline.matches.engine import worker as worker
from touchline.play.play_match import InProcessMatch

InProcessMatch(MatchConfig()).close()
gc.collect()
gc.freeze()  # what is here stays: the collector of a match need not look at it, and pages stay shared
