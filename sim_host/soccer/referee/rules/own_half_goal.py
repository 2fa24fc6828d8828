"""Goals from the own half: a goal counts only if it is scored from the other half, in some cases after a pass.

If the side won the ball in its own half, a teammate must have received a pass in the other half, after one metre of
free roll. Otherwise the goal does not count, and the other side has a goal kick. A defender's touch on the way does not
matter; a defender that held or kicked the ball into its own goal has scored for the other side.

Section: play, scoring.
Measures: the place of the ball at the last touch of the side that would score, the place where that side gained control
of it, and the straight distance between the touches of two of its robots. A ball that reaches over the halfway line is
in the other half.
Not judged: whether the receiver intended to receive the ball.
"""

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from sim_host.soccer.referee.evidence.play import Touch
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.rules.foul import CARDS, is_called, is_own_half
from sim_host.soccer.referee.rules.goal import is_in_goal
from sim_host.soccer.referee.situation import Crossing, Situation
from sim_host.soccer.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """No goal, and a goal kick for the defenders; or None."""
    crossing = situation.crossing
    if crossing is None or not is_in_goal(situation, crossing) or not is_called(situation, "own_half_goal"):
        return None
    play = situation.state.evidence.play
    side = next(side for side in Side if situation.state.attack(side) * crossing.x > 0)
    touch = play.of(side)
    if touch is None or play.control is side.opponent:
        return None
    measured, limit = -touch.place[0] * situation.state.attack(side), situation.match.book.scoring.pass_roll
    if is_own_half(situation, side, touch.place[0]):
        text = f"{touch.robot} played the ball {measured:.2f} m inside its own half, limit 0.00"
        return _no_goal(situation, crossing, side, touch, text, measured, 0.0)
    if play.won is not None and is_own_half(situation, side, play.won[0]) and not play.received:
        text = (
            f"{touch.robot} played the ball last, won in its own half at {place_text(play.won)}, and no teammate "
            f"received a pass in the other; the last one rolled {play.rolled:.2f} m, limit {limit:.2f}"
        )
        return _no_goal(situation, crossing, side, touch, text, play.rolled, limit)
    return None


def _no_goal(
    situation: Situation, crossing: Crossing, side: Side, touch: Touch, text: str, measured: float, limit: float
) -> Decision:
    return Decision(
        kind=EventKind.NO_GOAL,
        text=f"no goal for {side}: {text}",
        restart=restart_at(situation.match, situation.state, Phase.GOAL_KICK, side.opponent, (crossing.x, crossing.y)),
        side=side,
        robot=touch.robot,
        place=touch.place,
        measured=measured,
        limit=limit,
        unit="m",
        card=CARDS[situation.match.book.fouls.own_half_goal],
    )
