"""Touchline for users' code: what a brain, a test or a script needs, in one import.

    from touchline import Brain, Briefing, Command, Drive, Kick, Sight, play_match, skills

Names are imported when they are first used. A robot needs no PyBullet, and a script that plays no match does not
load it.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robot_agent.hardware.contract import BodyBall as BodyBall
    from robot_agent.hardware.contract import Hardware as Hardware
    from robot_agent.hardware.contract import Picture as Picture
    from robot_agent.hardware.contract import SensorReadings as SensorReadings
    from robot_agent.sdk.contract import Brain as Brain
    from robot_agent.sdk.contract import Briefing as Briefing
    from robot_agent.sdk.world_model import SeenBall as SeenBall
    from robot_agent.sdk.world_model import Teammate as Teammate
    from robot_agent.sdk.world_model import WorldBelief as WorldBelief
    from robot_agent.sdk.world_model import WorldModel as WorldModel
    from robot_agent.teams.action import Action as Action
    from robot_agent.teams.player import Player as Player
    from schemas.config.match_config import MatchConfig as MatchConfig
    from schemas.config.match_config import load_match as load_match
    from schemas.config.robot_model import RobotModel as RobotModel
    from schemas.config.sensors.compass import CompassReading as CompassReading
    from schemas.config.sensors.contact import ContactReading as ContactReading
    from schemas.config.sensors.range import RangeReading as RangeReading
    from schemas.messages.coach import CoachOrder as CoachOrder
    from schemas.messages.command import Command as Command
    from schemas.messages.command import Drive as Drive
    from schemas.messages.command import Kick as Kick
    from schemas.messages.command import KickMode as KickMode
    from schemas.messages.debug import Debug as Debug
    from schemas.messages.drawing import Drawing as Drawing
    from schemas.messages.radio import BallBelief as BallBelief
    from schemas.messages.radio import Motion as Motion
    from schemas.messages.radio import Radio as Radio
    from schemas.messages.sight import Obstacle as Obstacle
    from schemas.messages.sight import Sight as Sight
    from schemas.soccer.game import TeamPhase as TeamPhase
    from sim_host.task.score import Moment as Moment
    from sim_host.task.score import Score as Score
    from touchline import skills as skills
    from touchline.play.play_match import MatchOutcome as MatchOutcome
    from touchline.play.play_match import play_match as play_match

_NAMES = {
    "robot_agent.hardware.contract": ("BodyBall", "Hardware", "Picture", "SensorReadings"),
    "robot_agent.sdk.contract": ("Brain", "Briefing"),
    "robot_agent.teams.action": ("Action",),
    "robot_agent.teams.player": ("Player",),
    "robot_agent.sdk.world_model": ("SeenBall", "Teammate", "WorldBelief", "WorldModel"),
    "schemas.config.match_config": ("MatchConfig", "load_match"),
    "schemas.config.robot_model": ("RobotModel",),
    "schemas.config.sensors.compass": ("CompassReading",),
    "schemas.config.sensors.contact": ("ContactReading",),
    "schemas.config.sensors.range": ("RangeReading",),
    "schemas.soccer.game": ("TeamPhase",),
    "schemas.messages.coach": ("CoachOrder",),
    "schemas.messages.command": ("Command", "Drive", "Kick", "KickMode"),
    "schemas.messages.debug": ("Debug",),
    "schemas.messages.drawing": ("Drawing",),
    "schemas.messages.radio": ("BallBelief", "Motion", "Radio"),
    "schemas.messages.sight": ("Obstacle", "Sight"),
    "sim_host.task.score": ("Moment", "Score"),
    "touchline.play.play_match": ("MatchOutcome", "play_match"),  # these two need PyBullet
}
_HOMES = {name: module for module, names in _NAMES.items() for name in names}
__all__ = sorted([*_HOMES, "skills"])


def __getattr__(name: str) -> Any:
    if name == "skills":
        return import_module("touchline.skills")
    if name not in _HOMES:
        raise AttributeError(f"module 'touchline' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return __all__
