"""Touchline for users' code: what a brain, a test or a script needs, in one import.

    from touchline import Brain, Briefing, Command, Drive, Kick, Sight, play_match, skills

Names are imported when they are first used. A robot needs no PyBullet, and a script that plays no match does not
load it.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robot_agent.contract import Brain, Briefing
    from robot_agent.teams.action import Action
    from robot_agent.teams.player import Player
    from robot_agent.world_model import SeenBall, Teammate, WorldBelief, WorldModel
    from schemas.config.match_config import MatchConfig, load_match
    from schemas.game import TeamPhase
    from schemas.messages.coach import CoachOrder
    from schemas.messages.command import Command, Drive, Kick, KickMode
    from schemas.messages.debug import Debug
    from schemas.messages.drawing import Drawing
    from schemas.messages.radio import BallBelief, Motion, Radio
    from schemas.messages.sight import Sight
    from touchline import skills
    from touchline.play import MatchOutcome, play_match

_HOMES = {
    "Action": "robot_agent.teams.action",
    "BallBelief": "schemas.messages.radio",
    "Brain": "robot_agent.contract",
    "Briefing": "robot_agent.contract",
    "CoachOrder": "schemas.messages.coach",
    "Command": "schemas.messages.command",
    "Debug": "schemas.messages.debug",
    "Drawing": "schemas.messages.drawing",
    "Drive": "schemas.messages.command",
    "Kick": "schemas.messages.command",
    "KickMode": "schemas.messages.command",
    "MatchConfig": "schemas.config.match_config",
    "MatchOutcome": "touchline.play",
    "Motion": "schemas.messages.radio",
    "Player": "robot_agent.teams.player",
    "Radio": "schemas.messages.radio",
    "SeenBall": "robot_agent.world_model",
    "Sight": "schemas.messages.sight",
    "TeamPhase": "schemas.game",
    "Teammate": "robot_agent.world_model",
    "WorldBelief": "robot_agent.world_model",
    "WorldModel": "robot_agent.world_model",
    "load_match": "schemas.config.match_config",
    "play_match": "touchline.play",
}
"""Name → the module that defines it; `play_match` and `MatchOutcome` need PyBullet."""

__all__ = [
    "Action",
    "BallBelief",
    "Brain",
    "Briefing",
    "CoachOrder",
    "Command",
    "Debug",
    "Drawing",
    "Drive",
    "Kick",
    "KickMode",
    "MatchConfig",
    "MatchOutcome",
    "Motion",
    "Player",
    "Radio",
    "SeenBall",
    "Sight",
    "TeamPhase",
    "Teammate",
    "WorldBelief",
    "WorldModel",
    "load_match",
    "play_match",
    "skills",
]


def __getattr__(name: str) -> Any:
    if name == "skills":
        return import_module("touchline.skills")
    if name not in _HOMES:
        raise AttributeError(f"module 'touchline' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
