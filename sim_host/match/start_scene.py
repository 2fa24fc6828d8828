"""The start of a match as a scene, and the start poses of the robots, in the field frame with cyan attacking +x."""

import math

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.rule_book import Restarts, RuleBook
from schemas.config.scene import Scene, SceneGame, SceneRobot
from schemas.config.sections import Pitch
from schemas.frames import Pose
from schemas.game import Phase
from schemas.side import Side
from sim_host.match.live_parameters import LiveParameters
from sim_host.snapshot import Roster
from sim_host.staging.layout import LayoutChange, Specs, check_layout, scene_layout

_ON_22_BY_14 = ((-10.5, 0.0), (-2.0, 1.0), (-2.0, -1.0), (-5.0, 2.0), (-5.0, -2.0))
"""m; start poses of nubot-nu's simatch on a pitch of 22 × 14, the goalkeeper first; scaled to other pitches."""
_MARGIN = 0.05
"""m beyond the distance that the rules demand at a kick-off, since rounding may bring a robot nearer to the ball."""
_ROW = 9
"""Robots in each row behind the first five; every other row is shifted to the gaps of the row before."""


def opening_layout(config: MatchConfig, live_parameters: LiveParameters, book: RuleBook) -> tuple[Scene, LayoutChange]:
    """The scene that a match begins with, and the layout that it makes.

    Raises:
        TouchlineError: a side has more robots than the rule book allows, or the pitch has no room for a body.
    """
    profile = live_parameters.profile
    scene = config.scene if config.scene is not None else start_scene(config, profile, book.restarts)
    began = scene_layout(scene, "")
    check_layout(began.layout, Specs(profile.field, profile.ball, live_parameters.types, book), began.layout.names)
    return scene, began


def start_scene(config: MatchConfig, profile: Profile, restarts: Restarts) -> Scene:
    """The start of a match as a scene: robots at their start poses, the ball on the centre mark."""
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
    """One pose for each robot, in its own half and facing the goal it attacks; magenta's are cyan's turned by π.

    All robots keep the distance from the centre mark that the rules demand of the side that does not kick off, since
    either side may. A robot that stood nearer is moved away from the mark, as far as its own half allows.
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
    """Position of the robot with this index in its team's list, on a pitch of 22 × 14, in m."""
    if number < len(_ON_22_BY_14):
        return _ON_22_BY_14[number]
    row, column = divmod(number - len(_ON_22_BY_14), _ROW)
    return -6.2 - 0.75 * row, 1.4 * (column - _ROW // 2) + 0.7 * (row % 2)


def _clear_of_centre(x: float, y: float, distance: float, goal_line: float) -> tuple[float, float]:
    """The point moved along its radius to at least `distance` m from the centre mark, but not beyond the goal line."""
    out = max(1.0, min(distance / math.hypot(x, y), goal_line / abs(x)))
    return x * out, y * out
