"""Early touch: a robot other than the taker touches the ball before it is in play.

If it is a teammate of the taker, the other side gets the restart. If it is an opponent, the restart is repeated.

Section: restarts.
Measures: the robots that touch the ball, and its free roll since the taker's touch. The rule does not apply after the
time limit, when any robot may play the ball.
Not judged: whether the opponent could have avoided the ball.
"""

from schemas.soccer.game import Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.set_piece_foul import being_taken, given_away, restart_foul
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The restart for the other side, or the same restart again, or None."""
    piece = being_taken(situation)
    if piece is None or not piece.now or piece.restart.phase is Phase.DROP_BALL:
        return None
    roster, side = situation.match.roster, piece.restart.side
    for name in piece.now:
        is_mate = roster.side_of(name) is side
        if is_mate and name in (piece.kicker, _first_of_side(situation)):
            continue
        required = situation.match.book.restarts.in_play_distance
        who = "a teammate of the taker" if is_mate else "an opponent"
        text = f"{name}, {who}, touched the ball after {piece.rolled:.2f} m, in play after {required:.2f} m"
        restart = given_away(situation, piece) if is_mate else piece.restart
        return restart_foul(situation, name, text, restart, (piece.rolled, required, "m"))
    return None


def _first_of_side(situation: Situation) -> str | None:
    """The taker: the first robot of its side that touched the ball."""
    piece = situation.state.set_piece
    if piece is None:
        return None
    mine = (name for name in piece.touched if situation.match.roster.side_of(name) is piece.restart.side)
    return next(mine, None)
