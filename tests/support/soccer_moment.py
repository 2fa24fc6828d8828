"""A moment of a shipped soccer task: the start of its scene, with what a test changes, for its score function."""

from functools import cache
from importlib import import_module
from typing import Any

from schemas.config.match_config import MatchConfig
from schemas.config.profile import Profile
from schemas.messages.soccer.game import GameState
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.soccer.game import Score as Goals
from sim_host.snapshot import BallState, ObstacleState, RobotState
from sim_host.task.score import Moment, Score
from support.task_moment import task_config


def judged(
    task: str,
    ball: tuple[float, float] | None = None,
    places: dict[str, tuple[float, float]] | None = None,
    goals: tuple[int, int] = (0, 0),
    phase: Phase = Phase.PLAY,
    **changes: Any,
) -> Score:
    """The score of a moment: ball and robots in `places` elsewhere, in m, goals of cyan and magenta, and other fields
    of `Moment` in `changes`."""
    config, profile = _start(task)
    assert config.task is not None and config.scene is not None
    scene = config.scene
    robots = {one.name: RobotState(one.x, one.y, 0.4, one.heading, 0.0, 0.0, 0.0, False) for one in scene.robots}
    for name, (x, y) in (places or {}).items():
        robots[name] = robots[name]._replace(x=x, y=y)
    x, y = ball or (scene.ball.x, scene.ball.y)
    score = Goals(cyan=goals[0], magenta=goals[1])
    fields: dict[str, Any] = {
        "tick": 50,
        "time": 1.0,
        "robots": robots,
        "obstacles": {one.name: ObstacleState.of(one) for one in scene.obstacles},
        "contacts": frozenset(),
        "zones": {zone.name: zone for zone in config.task.zones},
        "pitch": profile.field,
        "sides": {one.name: Side(one.side) for one in scene.robots},
        "ball": BallState(x, y, 0.11, 0.0, 0.0, 0.0),
        "holder": None,
        "touches": (),
        "kicked": None,
        "events": (),
        "game": GameState(tick=50, time=1.0, phase=phase, running=phase is Phase.PLAY, score=score),
        "memory": None,
        "seed": 1,
    }
    module, _, function = config.task.score.partition(":")
    returned: Score | float = getattr(import_module(f"touchline.tasks.{module}"), function)(Moment(**fields | changes))
    return returned if isinstance(returned, Score) else Score(returned)


@cache
def _start(task: str) -> tuple[MatchConfig, Profile]:
    config = task_config(task)
    return config, config.load_profile()
