"""A moment of a shipped task without a ball, laid out by hand for its score function."""

from collections.abc import Iterable
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.profile import Profile
from schemas.messages.soccer.game import GameState
from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.snapshot import ObstacleState, RobotState
from sim_host.task.score import Moment, Score
from touchline import tasks

FOLDER = Path(tasks.__path__[0])
"""Where the tasks are."""


def task_config(task: str, seed: int = 1, **overrides: Any) -> MatchConfig:
    """The match of a task."""
    return load_match(FOLDER / f"{task}.toml", {"seed": seed} | overrides)


_config = cache(task_config)


@cache
def _profile(task: str) -> Profile:
    return _config(task).load_profile()


def scored(
    task: str,
    places: dict[str, tuple[float, ...]],
    memory: Any = None,
    moved: dict[str, tuple[float, float]] | None = None,
    contacts: Iterable[tuple[str, str]] = (),
    time: float = 1.0,
) -> Score:
    """The score of a moment with the robots, and the obstacles in `moved`, at these places in m.

    A robot's place may have its velocity along x, in m/s, as third number.
    """
    config = _config(task)
    assert config.task is not None and config.scene is not None
    profile = _profile(task)
    robots = {}
    for name, (x, y, *speed) in places.items():
        robots[name] = RobotState(x, y, 0.4, 0.0, sum(speed), 0.0, 0.0, holding=False)
    obstacles = {one.name: ObstacleState.of(one) for one in config.scene.obstacles}
    for name, (x, y) in (moved or {}).items():
        obstacles[name] = obstacles[name]._replace(x=x, y=y)
    tick = round(time / profile.time.tick)
    now = Moment(
        tick=tick,
        time=time,
        robots=robots,
        obstacles=obstacles,
        contacts=frozenset(contacts),
        zones={zone.name: zone for zone in config.task.zones},
        pitch=profile.field,
        sides={name: side for side in Side for name in config.robots(side)},
        ball=None,
        holder=None,
        touches=(),
        kicked=None,
        events=(),
        game=GameState(tick=tick, time=time, phase=Phase.PLAY, running=True, episode=1),
        memory=memory,
        seed=1,
    )
    module, _, function = config.task.score.partition(":")
    score = getattr(import_module(f"touchline.tasks.{module}"), function)(now)
    return score if isinstance(score, Score) else Score(score)
