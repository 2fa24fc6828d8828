"""The input of the rules in one tick: the state with advanced timers, the snapshot, and the line that was crossed."""

import dataclasses
from enum import Enum
from typing import NamedTuple

from schemas.soccer.game import SIDED, Phase
from sim_host.snapshot import BallState, Snapshot
from sim_host.soccer.referee.evidence import NO_EVIDENCE, evidence_after
from sim_host.soccer.referee.game.refbox_presence import refbox_gone_after
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Spot
from sim_host.soccer.referee.game.set_piece import set_piece_after
from sim_host.soccer.referee.game.shoot_out import ShootOut
from sim_host.soccer.referee.match_constants import MatchConstants
from sim_host.soccer.referee.placement.intrusions import intrusions_after
from sim_host.soccer.referee.placement.penalty_strays import with_strays


class Line(Enum):
    """A boundary line of the field."""

    TOUCH = "touch line"
    GOAL = "goal line"


class Crossing(NamedTuple):
    """The position of the ball's centre, in m, at the moment when the whole ball had passed a line."""

    line: Line
    x: float
    y: float
    z: float


class Situation(NamedTuple):
    """The input of the rules in one tick."""

    match: MatchConstants
    state: RefereeState
    snapshot: Snapshot
    crossing: Crossing | None

    @property
    def ball_spot(self) -> Spot:
        """Where the ball is, on the ground."""
        return self.snapshot.ball.x, self.snapshot.ball.y


def situation_after(match: MatchConstants, state: RefereeState, snapshot: Snapshot, dt: float) -> Situation:
    """The situation of this tick: the state after `dt` s more, with the evidence of this snapshot."""
    ball = snapshot.ball
    now = ball[:3]
    in_play = state.phase is Phase.PLAY
    slow = in_play and _is_still(ball, match.book.stall.still_speed)
    seen = NO_EVIDENCE
    if state.running:
        seen = evidence_after(
            match,
            state.evidence,
            match.keepers(state.participation.absences),
            state.cyan_attacks,
            snapshot,
            dt,
            in_play=in_play,
        )
    refbox_gone = state.refbox_gone
    if snapshot.refbox or refbox_gone is not None:
        refbox_gone = refbox_gone_after(refbox_gone, snapshot.refbox, dt)
    now_state = state._replace(
        timing=state.timing.after(dt, in_play, limited=refbox_gone is None),
        set_piece=set_piece_after(state.set_piece, snapshot, in_play, dt),
        participation=state.participation.after(snapshot.silent, dt, state.running),
        proposal=None if state.proposal is None else state.proposal.after(dt),
        advantage=None if state.advantage is None else state.advantage.after(dt),
        still=state.still + dt if slow else 0.0,
        ball=now,
        evidence=seen,
        refbox_gone=refbox_gone,
        questions=tuple([question.after(dt) for question in state.questions]) if state.questions else (),
    )
    if state.phase is Phase.PENALTY and state.running:
        now_state = with_strays(match, now_state, snapshot)
    if state.shoot_out is not None and state.running:
        now_state = now_state._replace(shoot_out=_with_nearest_ball(match, now_state, snapshot, state.shoot_out))
    piece = now_state.set_piece
    if piece is not None and state.running and not in_play and is_encroachment_judged(match, now_state):
        now_state = now_state._replace(set_piece=intrusions_after(match, now_state, piece, snapshot, dt))
    inside = abs(ball.x) <= match.out_x and abs(ball.y) <= match.out_y
    crossing = None if inside or state.ball is None else crossed(match, state.ball, now)
    return Situation(match, now_state, snapshot, crossing)


def is_encroachment_judged(match: MatchConstants, state: RefereeState) -> bool:
    """Whether robots may encroach on this restart: penalties and dropped balls have rules of their own."""
    return match.book.fouls.encroachment != "off" and state.phase in SIDED and state.phase is not Phase.PENALTY


def crossed(
    match: MatchConstants, before: tuple[float, float, float], now: tuple[float, float, float]
) -> Crossing | None:
    """The first line that the ball crossed on the straight line from `before` to `now`; None if it was out before."""
    first: tuple[float, Line] | None = None
    for axis, limit, line in ((0, match.out_x, Line.GOAL), (1, match.out_y, Line.TOUCH)):
        if abs(before[axis]) > limit:
            return None
        if abs(now[axis]) > limit:
            way = abs(now[axis] - before[axis])
            edge = limit if now[axis] > 0 else -limit
            share = abs(edge - before[axis]) / way
            if first is None or share < first[0]:
                first = (share, line)
    if first is None:
        return None
    share, line = first
    x, y, z = (b + share * (n - b) for b, n in zip(before, now, strict=True))
    return Crossing(line, x, y, z)


def _with_nearest_ball(match: MatchConstants, state: RefereeState, snapshot: Snapshot, out: ShootOut) -> ShootOut:
    """The shoot-out with the nearest distance between the goal line and the ball while its taker held it."""
    holder, side = snapshot.possession, state.side
    if holder is None or side is None or snapshot.roster.side_of(holder) is not side:
        return out
    near = match.pitch.goal_line - snapshot.ball.x * state.attack(side)
    return dataclasses.replace(out, nearest=near if out.nearest is None else min(near, out.nearest))


def _is_still(ball: BallState, speed: float) -> bool:
    return ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz < speed * speed
