"""Set pieces of our own: whom the taker plays to, and when. Against us, the formation's places are made legal."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.soccer.skills.pass_to import pass_speed
from robot_agent.teams.reference.clearing import best_clear
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import Pass, passes
from schemas.config.sections import Pitch
from schemas.frames import Point
from schemas.messages.setup import Setup
from schemas.soccer.game import TeamPhase

KICK_OFF_TO = (0.8, 3.0)
"""m; where the taker of a kick-off points before START: ahead, so that it waits behind the ball in its own half."""


class Restart(NamedTuple):
    """What the taker knows."""

    phase: TeamPhase
    spot: Point
    mates: Mapping[str, Body]
    """Teammates in the field."""
    opponents: Sequence[Point]
    running: bool
    """Whether START was given."""
    waited: float
    """s since START."""
    away: float
    """m from the taker to the ball."""
    chosen: Pass | None
    """The pass that it aimed at a tick ago."""


class RestartKick(NamedTuple):
    """How a restart is played."""

    target: Point
    speed: float
    """m/s."""
    error: float
    """m beside the target at most."""
    aimed: Pass | None
    """The pass, once there is a receiver."""
    waits: bool = False
    """Whether the taker waits for a receiver that is free."""


def restart_kick(now: Restart, setup: Setup, parameters: Parameters) -> RestartKick:
    """The kick of a restart of our own: a penalty at the goal, anything else to the best receiver."""
    pitch = setup.pitch
    if now.phase is TeamPhase.OUR_PENALTY:
        corner = pitch.goal_line, parameters.penalty_corner * pitch.goal_width
        return RestartKick(corner, setup.kicker.max_ground_speed, parameters.shot_error, None)
    best = _receiver(now, pitch, parameters)
    is_over = not now.running or now.waited > parameters.restart_wait
    if best is None and is_over and now.spot[0] < parameters.clears_before:
        best = best_clear(now.spot, 0.0, now.opponents, pitch, parameters)
    if best is not None:
        return RestartKick(best.target, *best.strength(now.spot, setup, parameters), best)
    speed = pass_speed(math.dist(now.spot, KICK_OFF_TO), setup, parameters.pass_arriving)
    return RestartKick(KICK_OFF_TO, speed, parameters.pass_error, None, waits=not is_over)


def _receiver(now: Restart, pitch: Pitch, parameters: Parameters) -> Pass | None:
    """The pass of the restart; what was chosen stays while the taker steps in.

    That of a kick-off is found after START only: back, most often, for which the taker goes into the other half.
    """
    if now.phase is TeamPhase.OUR_KICK_OFF and not now.running:
        return None
    if now.running and now.away < parameters.stepped_in and now.chosen is not None:
        return now.chosen
    waited = now.waited if now.running else math.inf
    chosen = (now.chosen.receiver, now.chosen.target) if now.chosen is not None else None
    return best_restart(now.spot, now.mates, now.opponents, chosen, waited, pitch, parameters)


def best_restart(
    spot: Point,
    mates: Mapping[str, Body],
    opponents: Sequence[Point],
    chosen: tuple[str, Point] | None,
    waited: float,
    pitch: Pitch,
    parameters: Parameters,
) -> Pass | None:
    """The pass that is played, once one is sure enough or the time is up; None to wait.

    Args:
        waited: s since START.
    """
    toward = math.atan2(-spot[1], -spot[0])
    found = passes(spot, toward, mates, opponents, chosen, pitch, parameters)
    best = max(found, key=lambda one: one.chance + one.value, default=None)
    if best is None or (best.chance < parameters.restart_sure and waited < parameters.restart_wait):
        return None
    return best
