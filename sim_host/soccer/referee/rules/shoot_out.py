"""Penalty shoot-out: one attempt ends with a goal or without one.

The kicker starts in the centre circle, catches the ball, moves it only toward the goal, and kicks once, before the ball
enters the penalty area. The attempt ends without a goal when the ball leaves the field, enters the penalty area without
a kick, moves away from the goal while the kicker holds it, is touched again by the kicker's side after the kick, is
held by the other side, is at rest after the kick, or when the time is up.

Section: match, play-offs; penalty shoot-out.
Measures: the place of the ball, the kick, touches after it, and the time since START.
Not judged: the places of the other robots, which the rule `penalty_kick` judges.
"""

from schemas.side import Side
from schemas.soccer.game import EventKind
from sim_host.soccer.referee.areas import in_penalty_area
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.set_piece import KICK_DURATION, SetPiece
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.rules.goal import is_in_goal
from sim_host.soccer.referee.situation import Situation

BACKWARD = 0.2
"""m that a held ball may move away from the goal, as when a robot turns with it (ours)."""
SLOW = 1.0
"""s after the kick, from when on a ball at rest ends the attempt (ours)."""


def judge(situation: Situation) -> Decision | None:
    """The end of the attempt, or None."""
    piece, side = situation.state.set_piece, situation.state.side
    if piece is None or side is None:
        return None
    crossing = situation.crossing
    if crossing is not None:
        end = situation.state.attack(side)
        scored = is_in_goal(situation, crossing) and crossing.x * end > 0 and piece.kicker is not None
        return _over(situation, piece, side, scored, "ball in the goal" if scored else "ball out, no goal")
    missed = _missed(situation, piece, side)
    return None if missed is None else _over(situation, piece, side, False, *missed)


def _missed(situation: Situation, piece: SetPiece, side: Side) -> tuple[str, float | None, float | None, str] | None:
    """Why the attempt has ended without a goal: text, measured quantity, limit and unit; or None."""
    state, snapshot, match = situation.state, situation.snapshot, situation.match
    ball, end, limit = snapshot.ball, state.attack(side), match.book.periods.shoot_out_limit
    if reached(state.timing.timer, limit) and not state.refbox_decides:
        return f"no goal within {limit:g} s", state.timing.timer, limit, "s"
    holder = snapshot.possession
    if holder is not None and match.roster.side_of(holder) is not side:
        return f"{holder} has the ball", None, None, ""
    if piece.kicker is None:
        if in_penalty_area(match.pitch, end, ball.x, ball.y):
            return "the ball entered the penalty area without a kick", None, None, ""
        return _backward(situation, side)
    again = [name for name in piece.now if match.roster.side_of(name) is side]
    if again and piece.since_kick > KICK_DURATION:
        return f"{again[-1]} touched the ball again after the kick, one kick is allowed", None, None, ""
    if piece.since_kick > SLOW and ball.vx**2 + ball.vy**2 + ball.vz**2 < match.book.stall.still_speed**2:
        return "the ball is at rest after the kick", None, None, ""
    return None


def _backward(situation: Situation, side: Side) -> tuple[str, float, float, str] | None:
    """The end of the attempt because the kicker has moved the held ball away from the goal; or None."""
    out, snapshot = situation.state.shoot_out, situation.snapshot
    holder = snapshot.possession
    if out is None or out.nearest is None or holder is None or situation.match.roster.side_of(holder) is not side:
        return None
    back = situation.match.pitch.goal_line - situation.snapshot.ball.x * situation.state.attack(side) - out.nearest
    if back <= BACKWARD:
        return None
    return f"{holder} moved the ball {back:.2f} m away from the goal, limit {BACKWARD:.2f} m", back, BACKWARD, "m"


def _over(
    situation: Situation,
    piece: SetPiece,
    side: Side,
    scored: bool,
    why: str,
    measured: float | None = None,
    limit: float | None = None,
    unit: str = "",
) -> Decision:
    return Decision(
        kind=EventKind.SHOT,
        text=f"penalty of {side} {'scored' if scored else 'missed'}: {why}",
        shot_scored=scored,
        side=side,
        robot=piece.kicker or piece.taker,
        place=situation.ball_spot,
        measured=measured,
        limit=limit,
        unit=unit,
    )
