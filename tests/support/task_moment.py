"""A moment of a shipped task, for its score function: the start of its scene, and what a test changes in it."""

from collections.abc import Iterable, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.profile import Profile
from schemas.config.task import GameName
from schemas.messages.soccer.game import GameState
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.soccer.game import Score as Goals
from sim_host.snapshot import BallState, ObstacleState, RobotState
from sim_host.task.score import Moment, Score
from touchline import tasks

FOLDER = Path(tasks.__path__[0])
"""Where the tasks are."""


def task_config(task: str, seed: int = 1, **overrides: Any) -> MatchConfig:
    """The match of a task."""
    return load_match(FOLDER / f"{task}.toml", {"seed": seed} | overrides)


def scored(
    task: str,
    places: Mapping[str, tuple[float, ...]] | None = None,
    memory: Any = None,
    *,
    ball: tuple[float, float] | None = None,
    moved: Mapping[str, tuple[float, float]] | None = None,
    contacts: Iterable[tuple[str, str]] = (),
    goals: tuple[int, int] = (0, 0),
    phase: Phase = Phase.PLAY,
    time: float = 1.0,
    **changes: Any,
) -> Score:
    """The score of a moment with robots in `places`, the ball, and the obstacles in `moved` there, in m.

    A robot's place may have its velocity along x, in m/s, as third number. `goals` are cyan's and magenta's, and
    `changes` are other fields of `Moment`.
    """
    config, profile = _start(task)
    assert config.task is not None and config.scene is not None
    scene = config.scene
    robots = {one.name: RobotState(one.x, one.y, 0.4, one.heading, 0.0, 0.0, 0.0, False) for one in scene.robots}
    for name, (x, y, *speed) in (places or {}).items():
        robots[name] = robots[name]._replace(x=x, y=y, vx=sum(speed))
    obstacles = {one.name: ObstacleState.of(one) for one in scene.obstacles}
    for name, (x, y) in (moved or {}).items():
        obstacles[name] = obstacles[name]._replace(x=x, y=y)
    x, y = ball or (scene.ball.x, scene.ball.y)
    tick, score = round(time / profile.time.tick), Goals(cyan=goals[0], magenta=goals[1])
    fields: dict[str, Any] = {
        "tick": tick,
        "time": time,
        "robots": robots,
        "obstacles": obstacles,
        "contacts": frozenset(contacts),
        "zones": {zone.name: zone for zone in config.task.zones},
        "pitch": profile.field,
        "sides": {one.name: Side(one.side) for one in scene.robots},
        "ball": BallState(x, y, 0.11, 0.0, 0.0, 0.0) if config.game is GameName.SOCCER else None,
        "holder": None,
        "touches": (),
        "kicked": None,
        "events": (),
        "game": GameState(tick=tick, time=time, phase=phase, running=phase is Phase.PLAY, score=score),
        "memory": memory,
        "seed": 1,
    }
    module, _, function = config.task.score.partition(":")
    returned: Score | float = getattr(import_module(f"touchline.tasks.{module}"), function)(Moment(**fields | changes))
    return returned if isinstance(returned, Score) else Score(returned)


@cache
def _start(task: str) -> tuple[MatchConfig, Profile]:
    config = task_config(task)
    return config, config.load_profile()
