"""Where robots stand at the beginning of a half, in the field frame, for cyan attacking +x."""

import math

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.rule_book import Restarts
from schemas.config.scene import Scene, SceneGame, SceneRobot
from schemas.config.sections import Pitch
from schemas.frames import Pose
from schemas.game import Phase
from schemas.side import Side
from sim_host.match.live_parameters import LiveParameters
from sim_host.snapshot import Roster
from sim_host.staging.layout import LayoutChange, Specs, check_layout, scene_layout

_ON_22_BY_14 = ((-10.5, 0.0), (-2.0, 1.0), (-2.0, -1.0), (-5.0, 2.0), (-5.0, -2.0))
"""m; simatch's start poses on a pitch of 22 × 14, the goalkeeper first; scaled to other pitches."""
_MARGIN = 0.05
"""m beyond what the rules ask for at a kick-off: a robot that stands exactly there is as well a rounding nearer."""
_ROW = 9
"""Robots beyond five stand beside each other in rows of so many, behind the others, every other row in the gaps."""


def opening_layout(
    config: MatchConfig, live_parameters: LiveParameters, restarts: Restarts
) -> tuple[Scene, LayoutChange]:
    """The scene that a match begins with, and the layout that it makes.

    Raises:
        TouchlineError: a body would begin in another, or outside the field.
    """
    profile = live_parameters.profile
    scene = config.scene if config.scene is not None else start_scene(config, profile, restarts)
    began = scene_layout(scene, "")
    check_layout(began.layout, Specs(profile.field, profile.ball, live_parameters.types), began.layout.names)
    return scene, began


def start_scene(config: MatchConfig, profile: Profile, restarts: Restarts) -> Scene:
    """The start of a match as a scene: everybody at the start poses, the ball at the centre mark."""
    roster = Roster.of(config, profile)
    poses = start_poses(roster, profile.field, restarts)
    robots = [
        SceneRobot(
            name=name,
            side=side,
            type=model.type,
            keeper=roster.keepers[side] == name,
            x=poses[name].x,
            y=poses[name].y,
            heading=poses[name].heading,
        )
        for name, side, model in zip(roster.names, roster.sides, roster.models, strict=True)
    ]
    description = f"The start of the match {config.name}."
    return Scene(
        name="start",
        description=description,
        game=SceneGame(phase=Phase.PRE_GAME),
        robots=robots,
        obstacles=config.obstacles,
    )


def start_poses(roster: Roster, pitch: Pitch, restarts: Restarts) -> dict[str, Pose]:
    """One pose for each robot: all in their own half, facing the goal they attack, magenta's cyan's turned by π.

    Whole robots stand as far from the centre mark as the rules ask of the side that does not kick off, which either
    may be: who stood nearer moves out from the mark, as far as the own half lets it.
    """
    distance = max(restarts.opponent_distance, restarts.teammate_distance) + _MARGIN
    poses = {}
    for side in Side:
        mine = [place for place, its_side in enumerate(roster.sides) if its_side is side]
        for number, place in enumerate(mine):
            x, y = _start_position(number)
            x, y = x * pitch.length / 22.0, y * pitch.width / 14.0
            reach = roster.models[place].body.reach
            x, y = _clear_of_centre(x, y, distance + reach, pitch.goal_line - reach)
            poses[roster.names[place]] = Pose(x, y).team(side.attack(1))
    return poses


def _start_position(number: int) -> tuple[float, float]:
    """Where the robot of this number in its team's list stands on a pitch of 22 × 14, m."""
    if number < len(_ON_22_BY_14):
        return _ON_22_BY_14[number]
    row, column = divmod(number - len(_ON_22_BY_14), _ROW)
    return -6.2 - 0.75 * row, 1.4 * (column - _ROW // 2) + 0.7 * (row % 2)


def _clear_of_centre(x: float, y: float, distance: float, goal_line: float) -> tuple[float, float]:
    """The place at least `distance` m from the centre mark, along its own radius, and not beyond the goal line."""
    out = max(1.0, min(distance / math.hypot(x, y), goal_line / abs(x)))
    return x * out, y * out
