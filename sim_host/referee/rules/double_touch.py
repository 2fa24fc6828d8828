"""Double touch: the taker kicks, and touches the ball again before it is in play; the other side gets the restart.

Section: restarts.
Measures: the free roll between the kick and the second touch. Contacts in the first tenth of a second belong to the
kick.
Not judged: intent; a ball that comes back from the boundary or an opponent is no exception.
"""

from schemas.game import EventKind
from sim_host.referee.decision import Decision
from sim_host.referee.rules.set_piece_foul import being_taken, given_away
from sim_host.referee.scene import Scene
from sim_host.referee.set_piece import KICK


def judge(scene: Scene) -> Decision | None:
    """The restart for the other side, or nothing."""
    piece = being_taken(scene)
    if piece is None or piece.kicker is None or piece.kicker not in piece.now or piece.since_kick <= KICK:
        return None
    asked = scene.match.book.restarts.in_play_distance
    return Decision(
        kind=EventKind.FOUL,
        text=f"{piece.kicker} touched the ball twice: it had rolled {piece.rolled:.2f} m, in play after {asked:.2f} m",
        restart=given_away(scene, piece),
        side=piece.restart.side,
        robot=piece.kicker,
        place=(scene.snapshot.ball.x, scene.snapshot.ball.y),
        measured=piece.rolled,
        limit=asked,
        unit="m",
    )
