"""Penalty kick: all robots but the kicker keep their places until the ball is kicked.

The goalkeeper moves within its goal area; all others stay outside the penalty area, away from the ball and behind it,
in a shoot-out beyond the halfway line. If a robot of the defending side has left its place, a goal counts, and without
a goal the penalty is taken again. If one of the attacking side has, a goal does not count and the penalty is taken
again; without a goal the other side gets a free kick where the penalty was taken, and in a shoot-out the penalty is
missed. If robots of both sides have, it is taken again.

Section: restarts, penalty; its consequences follow the Laws of the Game.
Measures: the places of robots as before START, in every tick until the kick, in a shoot-out until the kicker's side
touches the ball, for robots beyond the halfway line until the end of the attempt. A penalty has ended without a goal
when the ball leaves the field, no longer moves toward the goal, or is touched by a robot other than kicker and
goalkeeper.
Not judged: whether a robot was pushed, or has gained anything by it.
"""

from collections.abc import Sequence

from schemas.side import Side
from schemas.soccer.game import EventKind, GameStage, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.game.set_piece import KICK_DURATION, PositionFault, SetPiece
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.rules import shoot_out
from sim_host.soccer.referee.rules.foul import CARDS
from sim_host.soccer.referee.rules.goal import is_in_goal
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The penalty again, or a free kick for the other side, or None."""
    piece = situation.state.set_piece
    if piece is None or not piece.strays or piece.restart.phase is not Phase.PENALTY:
        return None
    side, scored = piece.restart.side, _outcome(situation, piece)
    if side is None or scored is None:
        return None
    sides = {sign: [stray for stray in piece.strays if _side(situation, stray) is sign] for sign in Side}
    attackers, defenders = sides[side], sides[side.opponent]
    if attackers and defenders:
        return _decision(situation, [*attackers, *defenders], "it is taken again", piece.restart, card=False)
    if defenders:
        return None if scored else _decision(situation, defenders, "no goal, the penalty is taken again", piece.restart)
    if scored:
        return _decision(situation, attackers, "the goal does not count, the penalty is taken again", piece.restart)
    if situation.state.stage is GameStage.SHOOT_OUT:
        return None
    free_kick = restart_at(situation.match, situation.state, Phase.FREE_KICK, side.opponent, piece.restart.spot)
    return _decision(situation, attackers, "no goal", free_kick)


def _outcome(situation: Situation, piece: SetPiece) -> bool | None:
    """Whether the penalty has ended in this tick with a goal, True, or without one, False; None while it is open."""
    state, crossing, side = situation.state, situation.crossing, piece.restart.side
    if state.stage is GameStage.SHOOT_OUT:
        attempt = shoot_out.judge(situation)
        return None if attempt is None else attempt.shot_scored
    if crossing is not None and side is not None:
        return is_in_goal(situation, crossing) and crossing.x * state.attack(side) > 0
    is_taken = state.phase is Phase.PLAY or (piece.kicker is not None and piece.since_kick > KICK_DURATION)
    return False if is_taken and _is_stopped(situation, piece) else None


def _is_stopped(situation: Situation, piece: SetPiece) -> bool:
    """Whether the ball no longer moves toward the goal, or a robot other than kicker and goalkeeper has touched it."""
    match, state, snapshot, side = situation.match, situation.state, situation.snapshot, piece.restart.side
    if side is None or snapshot.ball.vx * state.attack(side) < match.book.stall.still_speed:
        return True
    keepers = match.keepers(state.participation.absences)
    guards = [name for name, keeps in zip(match.roster.names, keepers, strict=True) if keeps]
    return snapshot.possession is not None or any(
        name != piece.kicker and name not in guards for name in snapshot.touches
    )


def _side(situation: Situation, stray: PositionFault) -> Side:
    return situation.match.roster.side_of(stray.robot)


def _decision(
    situation: Situation, strays: Sequence[PositionFault], outcome: str, restart: Restart, *, card: bool = True
) -> Decision:
    first = strays[0]
    robots = tuple([stray.robot for stray in strays])
    return Decision(
        kind=EventKind.FOUL,
        text=f"{' and '.join(stray.text for stray in strays)}: {outcome}",
        restart=restart,
        side=_side(situation, first),
        robot=first.robot,
        robots=robots if len(robots) > 1 else (),
        place=situation.ball_spot,
        measured=first.measured,
        limit=first.limit,
        unit="m" if first.limit is not None else "",
        card=CARDS[situation.match.book.fouls.penalty_kick] if card else None,
    )
