"""Own goal from the own restart: a ball that goes straight from a restart into the taker's own goal is a corner.

Once another robot has touched the ball, an own goal counts for the other side like any goal.

Section: restarts; follows the Laws of the Game, since in the league's rule book one robot alone cannot score.
Measures: whether a single robot, of the taker's side, has touched the ball since START; with a rule book that requires
no second robot, the goal counts.
Not judged: whether another robot's touch was more than a deflection.
"""

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.rules.goal import is_in_goal
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import last_touch_text, place_text


def judge(situation: Situation) -> Decision | None:
    """A corner for the other side, or None."""
    crossing, piece = situation.crossing, situation.state.set_piece
    if crossing is None or piece is None or not is_in_goal(situation, crossing):
        return None
    scorers = next(side for side in Side if situation.state.attack(side) * crossing.x > 0)
    taker, required = piece.restart.side, situation.match.book.scoring.robots_touched
    alone = len(piece.touched) == piece.touchers(situation.match.roster, taker) == 1 if taker is not None else False
    if taker is not scorers.opponent or not alone or required == 1:
        return None
    place = (crossing.x, crossing.y)
    return Decision(
        kind=EventKind.NO_GOAL,
        text=f"no own goal: the ball went in at {place_text(place)} straight from {taker}'s own restart, "
        f"{last_touch_text(situation.state.last_touch)}",
        restart=restart_at(situation.match, situation.state, Phase.CORNER, scorers, place),
        side=taker,
        robot=situation.state.last_touch,
        place=place,
        measured=1,
        limit=required,
        unit="robots",
    )
