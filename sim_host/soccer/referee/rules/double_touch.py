"""Double touch: the taker kicks, and touches the ball again before it is in play. The other side gets the restart.

Section: restarts.
Measures: the free roll between the kick and the second touch. Contacts in the first tenth of a second belong to the
kick.
Not judged: intent; a ball that comes back from the boundary or an opponent is no exception.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.set_piece import KICK_DURATION
from sim_host.soccer.referee.rules.set_piece_foul import being_taken, given_away, restart_foul
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The restart for the other side, or None."""
    piece = being_taken(situation)
    if piece is None or piece.kicker is None or piece.kicker not in piece.now or piece.since_kick <= KICK_DURATION:
        return None
    asked = situation.match.book.restarts.in_play_distance
    text = f"{piece.kicker} touched the ball twice: it had rolled {piece.rolled:.2f} m, in play after {asked:.2f} m"
    return restart_foul(situation, piece.kicker, text, given_away(situation, piece), (piece.rolled, asked, "m"))
