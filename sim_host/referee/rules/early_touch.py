"""Early touch: somebody else than the taker touches the ball before it is in play.

A teammate of the taker gives the restart to the other side; an opponent has it repeated.

Section: restarts.
Measures: who touches the ball, and how far it had rolled freely since the taker's touch; nothing after the time limit,
when anybody may take it.
Not judged: whether the opponent could have got out of the way.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.decision import Decision
from sim_host.referee.rules.set_piece_foul import being_taken, given_away
from sim_host.referee.scene import Scene


def judge(scene: Scene) -> Decision | None:
    """The restart for the other side, or the same again, or nothing."""
    piece = being_taken(scene)
    if piece is None or not piece.now or piece.restart.phase is Phase.DROP_BALL:
        return None
    roster, side = scene.match.roster, piece.restart.side
    for name in piece.now:
        is_mate = roster.side_of(name) is side
        if is_mate and name in (piece.kicker, _first_of_side(scene)):
            continue
        asked = scene.match.book.restarts.in_play_distance
        who = "a teammate of the taker" if is_mate else "an opponent"
        place = (scene.snapshot.ball.x, scene.snapshot.ball.y)
        return Decision(
            kind=EventKind.FOUL,
            text=f"{name}, {who}, touched the ball after {piece.rolled:.2f} m, in play after {asked:.2f} m",
            restart=given_away(scene, piece) if is_mate else piece.restart,
            side=roster.side_of(name),
            robot=name,
            place=place,
            measured=piece.rolled,
            limit=asked,
            unit="m",
        )
    return None


def _first_of_side(scene: Scene) -> str | None:
    """The taker: the first robot of its side that touched the ball."""
    piece = scene.state.set_piece
    if piece is None:
        return None
    mine = (name for name in piece.touched if scene.match.roster.side_of(name) is piece.restart.side)
    return next(mine, None)
