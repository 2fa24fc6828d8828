"""The start of a match of soccer as a scene."""

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.config.scene import Scene, SceneGame, SceneRobot
from schemas.config.sections import Pitch
from schemas.config.soccer.rule_book import Restarts
from schemas.errors import TouchlineError
from schemas.soccer.game import Phase
from sim_host.snapshot import Roster
from sim_host.soccer.start_poses import start_poses


def start_scene(config: MatchConfig, profile: Profile, restarts: Restarts) -> Scene:
    """The start of a match as a scene: robots at their start poses, the ball on the centre mark.

    Raises:
        TouchlineError: the pitch has too few legal places for a kick-off of either side.
    """
    roster = Roster.of(config, profile)
    poses, misplaced = start_poses(roster, profile.field, restarts)
    if misplaced:
        raise TouchlineError(_why_misplaced(misplaced[0], roster, profile.field))
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


def _why_misplaced(name: str, roster: Roster, pitch: Pitch) -> str:
    """Why a match cannot begin."""
    side = roster.side_of(name)
    count = roster.sides.count(side)
    return (
        f"a half of {pitch.length / 2:g} × {pitch.width:g} m has no legal place at the kick-off for {name}, one of "
        f"{count} robots of {side}; have fewer robots, a larger pitch, or a scene"
    )
