"""Dragged ball: at a restart, the taker moves the ball with its body instead of kicking it.

The kick is to be instantaneous: before it, a ball that the taker touches may move as far as the rule book says. The
restart goes to the other side.

Section: restarts; 20 cm at a penalty since 2019, ours: at every restart.
Measures: the way from the spot to the ball while the taker touches it, before its kick.
Not judged: how the dribbler turns the ball on its spot.
"""

from schemas.game import EventKind
from sim_host.referee.decision import Decision
from sim_host.referee.rules.set_piece_foul import being_taken, given_away
from sim_host.referee.scene import Scene


def judge(scene: Scene) -> Decision | None:
    """The restart for the other side, or nothing."""
    piece = being_taken(scene)
    if piece is None or not piece.now or piece.kicker is not None:
        return None
    allowed = scene.match.book.restarts.drag_distance
    name = piece.now[-1]
    if piece.moved <= allowed or scene.match.roster.side_of(name) is not piece.restart.side:
        return None
    return Decision(
        kind=EventKind.FOUL,
        text=f"{name} dragged the ball {piece.moved:.2f} m from its spot, limit {allowed:.2f} m",
        restart=given_away(scene, piece),
        side=piece.restart.side,
        robot=name,
        place=(scene.snapshot.ball.x, scene.snapshot.ball.y),
        measured=piece.moved,
        limit=allowed,
        unit="m",
    )
