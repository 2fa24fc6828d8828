"""Early touch: somebody else than the taker touches the ball before it is in play.

A teammate of the taker gives the restart to the other side; an opponent has it repeated.

Section: restarts.
Measures: who touches the ball, and how far it had rolled freely since the taker's touch; nothing after the time limit,
when anybody may take it.
Not judged: whether the opponent could have got out of the way.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.game.decision import Decision
from sim_host.referee.rules.set_piece_foul import being_taken, given_away
from sim_host.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The restart for the other side, or the same again, or nothing."""
    piece = being_taken(situation)
    if piece is None or not piece.now or piece.restart.phase is Phase.DROP_BALL:
        return None
    roster, side = situation.match.roster, piece.restart.side
    for name in piece.now:
        is_mate = roster.side_of(name) is side
        if is_mate and name in (piece.kicker, _first_of_side(situation)):
            continue
        asked = situation.match.book.restarts.in_play_distance
        who = "a teammate of the taker" if is_mate else "an opponent"
        place = (situation.snapshot.ball.x, situation.snapshot.ball.y)
        return Decision(
            kind=EventKind.FOUL,
            text=f"{name}, {who}, touched the ball after {piece.rolled:.2f} m, in play after {asked:.2f} m",
            restart=given_away(situation, piece) if is_mate else piece.restart,
            side=roster.side_of(name),
            robot=name,
            place=place,
            measured=piece.rolled,
            limit=asked,
            unit="m",
        )
    return None


def _first_of_side(situation: Situation) -> str | None:
    """The taker: the first robot of its side that touched the ball."""
    piece = situation.state.set_piece
    if piece is None:
        return None
    mine = (name for name in piece.touched if situation.match.roster.side_of(name) is piece.restart.side)
    return next(mine, None)
