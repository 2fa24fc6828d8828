"""The common decision of both ball-out rules: line, place, last touch, and restart."""

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.rules.foul import Figures
from sim_host.soccer.referee.situation import Crossing, Situation
from sim_host.soccer.referee.wording import last_touch_text, level_touch_text, place_text


def dropped(
    situation: Situation,
    text: str,
    figures: Figures | None = None,
    *,
    robot: str | None = None,
    robots: tuple[str, ...] = (),
) -> Decision:
    """The decision to drop the ball where it is, or at the nearest legal place."""
    measured, limit, unit = figures or (None, None, "")
    return Decision(
        kind=EventKind.STALL,
        text=text,
        restart=restart_at(situation.match, situation.state, Phase.DROP_BALL, None, situation.ball_spot),
        robot=robot,
        robots=robots,
        place=situation.ball_spot,
        measured=measured,
        limit=limit,
        unit=unit,
    )


def ball_out(situation: Situation, crossing: Crossing, phase: Phase, taker: Side | None) -> Decision:
    """The decision on a ball that is out: a restart of `taker`, or of neither side if it is None."""
    level = situation.state.level_touches
    robot = situation.state.last_touch if not level else None
    place = (crossing.x, crossing.y)
    touched = level_touch_text(level) if level else last_touch_text(robot)
    return Decision(
        kind=EventKind.BALL_OUT,
        text=f"ball out over the {crossing.line.value} at {place_text(place)}, {touched}",
        restart=restart_at(situation.match, situation.state, phase, taker, place),
        side=situation.match.roster.side_of(robot) if robot is not None else None,
        robot=robot,
        robots=level,
        place=place,
    )
