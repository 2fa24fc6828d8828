"""The judge of a task: lets the game judge a tick, asks the score function, and ends the match."""

import json
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

from schemas.config.scene import SceneGame
from schemas.config.sections import Pitch
from schemas.config.task import TaskConfig, score_text
from schemas.messages.soccer.game import ActionReply, GameEvent, GameState, GameView, RefereeAction
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score, TeamPhase
from sim_host.game.judging import Absence, Judge, PlayState, Ruling
from sim_host.snapshot import Roster, Snapshot
from sim_host.task.score import Moment, ScoreFunction, call_score, load_score, memory_text

BY_TIME, BY_SCORE, BY_GAME = "time", "score", "game"
"""What has ended a task: its duration, its score function, or the game itself."""


class TaskState(NamedTuple):
    """The whole memory of a match with a task between two ticks."""

    game: PlayState
    """The state of the game."""
    duration: float | None
    """Simulated time after which it ends in s; None for the end of the game."""
    played: float = 0.0
    """s since it began."""
    value: float | None = None
    """The score; None before the first tick."""
    reward: float = 0.0
    """What a learner gets for the last tick."""
    ended_by: str = ""
    """`time`, `score` or `game`; empty while it goes on."""
    memory: str = "null"
    """What the score function remembers, as JSON."""

    @property
    def over(self) -> bool:
        """The task has ended."""
        return self.ended_by != ""

    @property
    def clock(self) -> float:
        """The clock of the game."""
        return self.game.clock

    @property
    def score(self) -> Score:
        """Goals of both sides."""
        return self.game.score

    @property
    def cyan_attacks(self) -> int:
        """The direction of the game."""
        return self.game.cyan_attacks

    @property
    def absences(self) -> Mapping[str, Absence]:
        """Robots that the game has off the field."""
        return self.game.absences

    @property
    def change_key(self) -> tuple[Any, ...]:
        """Score and end, besides what the game publishes."""
        return *self.game.change_key, self.value, self.over

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""
        return self.game.attack(side)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The published state: that of the game, with the score and the time that is left."""
        state = self.game.game_state(tick, time, episode)
        if self.over:
            state = state.replace(phase=Phase.FULL_TIME, side=None, running=False)
        return state.replace(value=self.value, left=self.left(state.left))

    def left(self, of_game: float | None) -> float | None:
        """Time in s until the limit that the game says is the next, or else until the duration is over."""
        if of_game is not None or self.duration is None:
            return of_game
        return max(0.0, self.duration - self.played)

    def after_layout_change(self, names: Collection[str]) -> "TaskState":
        """The state after an operator has moved bodies."""
        return self._replace(game=self.game.after_layout_change(names))


class TaskJudge:
    """A `sim_host.game.judging.Judge` around that of the game."""

    def __init__(
        self, task: TaskConfig, game: Judge, duration: float | None, seed: int, pitch: Pitch, roster: Roster
    ) -> None:
        self._task = task
        self._game = game
        self._duration = duration
        self._seed = seed
        self._pitch = pitch
        self._names = roster.names
        self._sides = dict(zip(roster.names, roster.sides, strict=True))
        self._zones = {zone.name: zone for zone in task.zones}

    @cached_property
    def _function(self) -> ScoreFunction:
        """The score function, whose module is run when the first tick is scored."""
        return load_score(self._task)

    def begin_at(self, game: SceneGame, ball: tuple[float, float]) -> TaskState:
        """The state with which a scene begins."""
        return TaskState(self._game.begin_at(game, ball), self._duration)

    def step(self, state: TaskState, snapshot: Snapshot, actions: Sequence[RefereeAction], dt: float) -> Ruling:
        """Judge and score one tick of `dt` in s.

        Raises:
            TouchlineError: the score function raises, or returns what is no score.
        """
        if state.over:
            refused = ActionReply(accepted=False, reason="the match is over", tick=snapshot.tick)
            return Ruling(state, replies=(refused,) * len(actions))
        ruling = self._game.step(state.game, snapshot, actions, dt)
        score = call_score(self._task, self._function, self._moment(state, snapshot, ruling))
        played, value = state.played + dt, float(score.value)
        reward = score.reward if score.reward is not None else value - (state.value or 0.0)
        ended_by = BY_GAME if ruling.state.over else BY_SCORE if score.over else ""
        if not ended_by and state.duration is not None and played >= state.duration - dt / 2:
            ended_by = BY_TIME
        after = TaskState(
            game=ruling.state,
            duration=state.duration,
            played=played,
            value=value,
            reward=float(reward),
            ended_by=ended_by,
            memory=memory_text(self._task, score.memory),
        )
        happened = [(EventKind.NOTE, " ".join(str(text).split())) for text in score.events]
        if after.over and not any(event.kind is EventKind.FULL_TIME for event in ruling.events):
            ending = f"ends after {played:.2f} s with the score {score_text(value, self._task.unit)}"
            happened.append((EventKind.FULL_TIME, ending))
        tick, time, clock = snapshot.tick, snapshot.time, after.clock
        events = [
            GameEvent(tick=tick, time=time, clock=clock, kind=kind, rule="score", text=text) for kind, text in happened
        ]
        return ruling._replace(state=after, events=(*ruling.events, *events))

    def views(self, state: TaskState, episode: int) -> Mapping[Side, GameView]:
        """Side → the game from its point of view, with the time that is left of the task."""
        changes: dict[str, Any] = {"phase": TeamPhase.FULL_TIME, "running": False} if state.over else {}
        views = self._game.views(state.game, episode)
        return {side: view.replace(left=state.left(view.left), **changes) for side, view in views.items()}

    def _moment(self, state: TaskState, snapshot: Snapshot, ruling: Ruling) -> Moment:
        game: PlayState = ruling.state
        return Moment(
            tick=snapshot.tick,
            time=snapshot.time,
            robots=dict(zip(self._names, snapshot.robots, strict=True)),
            obstacles={one.name: one for one in snapshot.obstacles},
            contacts=frozenset((self._names[one], self._names[other]) for one, other in snapshot.contacts),
            zones=self._zones,
            pitch=self._pitch,
            memory=json.loads(state.memory),
            seed=self._seed,
            sides=self._sides,
            ball=snapshot.ball_state,
            holder=snapshot.possession,
            touches=snapshot.touches,
            kicked=snapshot.kicked,
            events=ruling.events,
            game=game.game_state(snapshot.tick, snapshot.time),
        )
