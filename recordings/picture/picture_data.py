"""The data of pictures, read from a recording: moments, goals, and time in play."""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from recordings.reading.recording import RecordedMessage, open_recording
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topics import EVENT, STATE, WORLD

TRAIL_S = 3.0
"""Simulated time that trails reach back, in s."""
_HYPHENATED = {Phase.KICK_OFF: "kick-off", Phase.THROW_IN: "throw-in"}


class DrawnGoal(NamedTuple):
    """A goal: simulated time in s, the scoring side, and the position of the ball, in m in the field frame."""

    time: float
    side: Side | None
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class PanelData:
    """The world at one time, and the worlds before it."""

    worlds: list[World]
    """From the beginning of the trails to that time."""
    state: GameState | None

    @property
    def now(self) -> World:
        """The world at that time."""
        return self.worlds[-1]

    @property
    def score(self) -> Score | None:
        """The score at that time; None if no game state was recorded."""
        return self.state.score if self.state is not None else None

    @property
    def caption(self) -> str:
        """Game clock and phase."""
        minutes, seconds = divmod(int(self.now.clock), 60)
        clock = f"{minutes}:{seconds:02d}"
        if self.state is None:
            return clock
        phase = _HYPHENATED.get(self.state.phase, self.state.phase.value.replace("_", " "))
        return f"{clock}   {phase}, {self.state.side.value}" if self.state.side is not None else f"{clock}   {phase}"


class PictureData:
    """A recording, as pictures need it."""

    def __init__(self, path: Path) -> None:
        """Read the game states and goals.

        Raises:
            TouchlineError: not a recording, or a recording without the host's setup or without a world.
        """
        self._recording = recording = open_recording(path)
        self.setup = recording.setup
        self.start, self.end = recording.extent_of_worlds()
        messages = [message for _, message in recording.decoded(STATE.key, EVENT.key)]
        self._states: list[GameState] = [message for message in messages if isinstance(message, GameState)]
        self._state_times = [state.time for state in self._states]
        events = [message for message in messages if isinstance(message, GameEvent) and message.kind is EventKind.GOAL]
        self.goals = [goal for event in events for goal in self._goal(event)]

    def panel_data(self, time: float) -> PanelData:
        """The data of a panel at a simulated time in s.

        Raises:
            TouchlineError: no world was recorded at that time.
        """
        worlds = [world for _, world in self._worlds(time - TRAIL_S, time)]
        if not worlds or time < self.start:
            raise TouchlineError(
                f"{self._recording.path}: no world at {time:g} s; it has {self.start:g} to {self.end:g} s"
            )
        return PanelData(worlds, self._state_at(time))

    def score_at(self, time: float) -> Score | None:
        """The score at a simulated time in s."""
        state = self._state_at(time)
        return state.score if state is not None else None

    def last_play(self) -> float:
        """The last simulated time, in s, at which the ball was in play; the end of the recording if there is none."""
        return max((state.time for state in self._states if state.phase is Phase.PLAY), default=self.end)

    def in_play(self) -> list[World]:
        """The worlds in which the ball was in play; all worlds if there is no game state."""
        worlds = [world for _, world in self._worlds(self.start, self.end)]
        playing = [world for world in worlds if (state := self._state_at(world.time)) and state.phase is Phase.PLAY]
        return playing or worlds

    def _worlds(self, start: float, end: float) -> Iterator[tuple[RecordedMessage, World]]:
        return self._recording.decoded(WORLD.key, start=start, end=end + self.setup.time.tick / 2)

    def _state_at(self, time: float) -> GameState | None:
        before = bisect_right(self._state_times, time + self.setup.time.tick / 2)
        return self._states[before - 1] if before else None

    def _goal(self, event: GameEvent) -> list[DrawnGoal]:
        """The goal with the position of the ball; empty if that tick was not recorded."""
        balls = [world.ball for _, world in self._worlds(event.time, event.time)]
        return [DrawnGoal(event.time, event.side, balls[0].x, balls[0].y)] if balls else []
