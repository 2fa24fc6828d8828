"""The score of a task: a user's function of the true state, called once a tick.

    from touchline import Moment, Score

    def score(now: Moment) -> Score:
        done = now.zones["dock"].contains(now.obstacles["box"].x, now.obstacles["box"].y)
        return Score(value=float(done), over=done)

It may return a plain number, too. The same tick has to give the same score again: `verify` calls it with the recorded
match. What it remembers goes through `Score.memory` to the next `Moment.memory`, and what it draws comes from
`Moment.random`.
"""

import json
import math
import random
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from typing import Any

from schemas.config.sections import Pitch
from schemas.config.task import TaskConfig, Zone
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from sim_host.snapshot import BallState, ObstacleState, RobotState


@dataclass(frozen=True)
class Moment:
    """The true state of one tick, in the field frame: m, rad, m/s, rad/s."""

    tick: int
    """Control ticks since the match began, from 1."""
    time: float
    """Simulated time since the match began in s."""
    robots: Mapping[str, RobotState]
    """Robot → its state, in the order of the roster."""
    obstacles: Mapping[str, ObstacleState]
    """Obstacle → its state; `pushed` has the velocity of one that can be pushed."""
    contacts: frozenset[tuple[str, str]]
    """Pairs of robots that touch each other, in the order of the roster."""
    zones: Mapping[str, Zone]
    """Zone of the match file → its shape."""
    pitch: Pitch
    """The floor: `goal_line` and `touch_line` are its half length and width, and `border` what lies beyond in m."""
    sides: Mapping[str, Side]
    """Robot → its side."""
    ball: BallState | None
    """The ball; None in a game without one."""
    holder: str | None
    """The robot that holds the ball."""
    touches: tuple[str, ...]
    """Robots that touched, held or kicked the ball since the tick before, in order of their last touch."""
    kicked: str | None
    """The robot whose kick was carried out in this tick."""
    events: Sequence[GameEvent]
    """What the game's judge decided in this tick: goals, fouls, balls out, restarts."""
    game: GameState
    """The state of the game after it: phase, goals, clock."""
    memory: Any
    """What the tick before left in `Score.memory`; None in the first."""
    seed: int
    """Seed of the match."""

    @cached_property
    def random(self) -> random.Random:
        """Random numbers of this tick: equal for equal seeds and ticks."""
        return random.Random(f"{self.seed}/{self.tick}")


@dataclass(frozen=True)
class Score:
    """What a score function returns."""

    value: float
    """The score so far; a finite number."""
    over: bool = False
    """The match ends with this tick."""
    reward: float | None = None
    """What a learner gets for this tick; None for the change of `value`."""
    memory: Any = None
    """What the next tick needs: numbers, texts, lists and objects, as JSON has them."""
    events: Sequence[str] = ()
    """What happened in this tick, one sentence each: events of the match, such as "box 2 is delivered"."""


ScoreFunction = Callable[[Moment], Score | float]


def load_score(task: TaskConfig) -> ScoreFunction:
    """The score function of a config; runs the text of its module.

    Raises:
        TouchlineError: the module raises, or has no such function.
    """
    module, _, name = task.score.partition(":")
    names: dict[str, Any] = {"__name__": module}
    try:
        exec(compile(task.program, _file(task), "exec"), names)
    except Exception as error:
        raise _fault(task, error, "") from error
    found: ScoreFunction | None = names.get(name)
    if not callable(found):
        raise TouchlineError(f'task.score is "{task.score}"; {module} has no function {name}')
    return found


def call_score(task: TaskConfig, function: ScoreFunction, now: Moment) -> Score:
    """The score of a tick, checked.

    Raises:
        TouchlineError: the function raises, or returns anything but a finite number or a `Score`.
    """
    try:
        returned = function(now)
    except Exception as error:
        raise _fault(task, error, f" at tick {now.tick}") from error
    score = returned if isinstance(returned, Score) else Score(returned)
    numbers: tuple[object, ...] = (score.value, score.reward if score.reward is not None else 0.0)
    for number in numbers:
        if isinstance(number, bool) or not isinstance(number, Real) or not math.isfinite(number):
            raise TouchlineError(
                f'task.score is "{task.score}"; at tick {now.tick} it returned {number!r}; '
                "return a finite number, or a Score with one"
            )
    if isinstance(score.events, str) or not isinstance(score.events, Iterable):
        raise TouchlineError(
            f'task.score is "{task.score}"; at tick {now.tick} its events are {score.events!r}; '
            "return a list of sentences"
        )
    return score


def memory_text(task: TaskConfig, memory: Any) -> str:
    """The memory of a score as JSON.

    Raises:
        TouchlineError: JSON cannot hold it.
    """
    try:
        return json.dumps(memory, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise TouchlineError(f'task.score is "{task.score}"; its memory is no JSON: {error}') from None


def _file(task: TaskConfig) -> str:
    """The name of the module's file, for messages."""
    return task.score.partition(":")[0].replace(".", "/") + ".py"


def _fault(task: TaskConfig, error: Exception, when: str) -> TouchlineError:
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == _file(task)]
    line = f" ({_file(task)}, line {frames[-1].lineno})" if frames else ""
    reason = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return TouchlineError(f'task.score is "{task.score}"; it raised {reason}{line}{when}')
