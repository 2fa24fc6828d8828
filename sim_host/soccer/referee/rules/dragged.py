"""Dragged ball: at a restart, the taker moves the ball with its body instead of kicking it.

The kick has to be instantaneous: before it, a ball that the taker touches may move no farther than the rule book
allows. The other side gets the restart.

Section: restarts; 20 cm at a penalty since 2019; ours: at every restart.
Measures: the distance from the spot to the ball while the taker touches it, before its kick.
Not judged: how the dribbler turns the ball on its spot.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.set_piece_foul import being_taken, given_away, restart_foul
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The restart for the other side, or None."""
    piece = being_taken(situation)
    if piece is None or not piece.now or piece.kicker is not None:
        return None
    allowed = situation.match.book.restarts.drag_distance
    name = piece.now[-1]
    if piece.moved <= allowed or situation.match.roster.side_of(name) is not piece.restart.side:
        return None
    text = f"{name} dragged the ball {piece.moved:.2f} m from its spot, limit {allowed:.2f} m"
    return restart_foul(situation, name, text, given_away(situation, piece), (piece.moved, allowed, "m"))
