"""Where robots stand at the beginning of a half, in the field frame, for cyan attacking +x."""

from schemas.frames import Pose
from schemas.game import Phase
from schemas.match_config import MatchConfig
from schemas.profile import Field, Profile
from schemas.scene import Scene, SceneGame, SceneRobot
from schemas.side import Side
from sim_host.snapshot import Roster

_ON_22_BY_14 = ((-10.5, 0.0), (-2.0, 1.0), (-2.0, -1.0), (-5.0, 2.0), (-5.0, -2.0))
"""m; simatch's start poses on a pitch of 22 × 14, the goalkeeper first; scaled to other pitches."""


def start_scene(config: MatchConfig, profile: Profile) -> Scene:
    """The start of a match as a scene: everybody at the start poses, the ball at the centre mark."""
    roster = Roster.of(config, profile)
    poses = start_poses(roster, profile.field)
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
    says = f"The start of the match {config.name}."
    return Scene(
        name="start", says=says, game=SceneGame(phase=Phase.PRE_GAME), robots=robots, obstacles=config.obstacles
    )


def start_poses(roster: Roster, pitch: Field) -> dict[str, Pose]:
    """One pose for each robot: all in their own half, facing the goal they attack, magenta's cyan's turned by π."""
    poses = {}
    for side in Side:
        mine = [name for name, its_side in zip(roster.names, roster.sides, strict=True) if its_side is side]
        for name, (x, y) in zip(mine, _ON_22_BY_14, strict=False):
            poses[name] = Pose(x * pitch.length / 22.0, y * pitch.width / 14.0).team(side.attack(1))
    return poses
