"""The result of a match: as one JSON object for programs, as score and table for people."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import clock_text
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from touchline.launch.recording_outcome import NO_RECORDING, RecordingOutcome
from touchline.launch.terminal.agent_faults import missed_sights
from touchline.launch.terminal.json_text import json_text

NOTABLE = frozenset(EventKind) - {
    *(EventKind.STOP, EventKind.RESTART, EventKind.START, EventKind.IN_PLAY),
    *(EventKind.FOUL, EventKind.BALL_OUT, EventKind.PARKING),
}
"""Events in the printed result; stops and restarts are in the recording."""


@dataclass(frozen=True, slots=True)
class MatchResult:
    """The outcome of one match."""

    state: GameState
    """The game at its end."""
    duration_s: float
    """Simulated time in s."""
    ticks: int
    events: tuple[GameEvent, ...]
    real_time_factor: float
    """Simulated seconds per wall second of play."""
    wall_s: float
    """Wall time of play in s."""
    recording: RecordingOutcome = NO_RECORDING
    names: TeamNames = SIDES_ALONE
    """The teams' names."""
    missed: Mapping[str, int] = field(default_factory=dict)
    """Robot → sights that it did not answer, in lockstep."""

    @classmethod
    def of(cls, follower: MatchFollower, recording: RecordingOutcome, names: TeamNames) -> "MatchResult":
        """The result from the received messages."""
        return cls(
            state=follower.state or GameState(tick=0, time=0.0, phase=Phase.PRE_GAME),
            duration_s=follower.last.time if follower.last is not None else 0.0,
            ticks=follower.last.tick if follower.last is not None else 0,
            events=tuple(follower.events),
            real_time_factor=follower.real_time_factor,
            wall_s=follower.wall_s,
            recording=recording,
            names=names,
            missed=missed_sights(follower.health),
        )

    @property
    def halves(self) -> list[Score]:
        """The score at the end of each half; a shoot-out is none."""
        ending = {EventKind.HALF_TIME} if self.state.shoot_out else {EventKind.HALF_TIME, EventKind.FULL_TIME}
        ends = [event for event in self.events if event.kind in ending]
        return [event.score for event in ends if event.score is not None]

    def json(self) -> str:
        """One JSON object."""
        content = {
            "teams": {side.value: self.names[side] for side in Side},
            "score": self.state.score,
            "value": self.state.value,
            "halves": self.halves,
            "shoot_out": self.state.shoot_out,
            "cards": {name: {"yellow": one.yellow, "red": one.red} for name, one in self.state.robots.items()},
            "duration_s": round(self.duration_s, 6),
            "effective_s": round(self.state.effective, 6),
            "ticks": self.ticks,
            "events": [event.plain("version") for event in self.events],
            "real_time_factor": round(self.real_time_factor, 3),
            "wall_s": round(self.wall_s, 3),
            "recording": self.recording.path,
            "recording_fault": self.recording.fault or None,
            "losses": dict(self.recording.losses),
            "missed": dict(self.missed),
        }
        return json_text(content)

    def render(self) -> RenderableType:
        """Score, events and recording, for a console."""
        headline = Text(f"\n{self.names.score(self.state.score, self.state.value)}", style="bold")
        headline.append(
            f"   {self.duration_s:.1f} s played in {self.wall_s:.1f} s (×{self.real_time_factor:.1f})", style="not bold"
        )
        parts: list[RenderableType] = [headline, Text(self._summary()), self._table()]
        recording = self.recording
        if recording.path is not None:
            parts.append(Text(f"recording  {recording.path}", no_wrap=True, overflow="ignore"))
        if recording.losses and not recording.fault:
            losses = dict(recording.losses)
            parts.append(Text(f"messages that did not reach the host: {losses}", style="yellow"))
        return Group(*parts)

    def _summary(self) -> str:
        """Score by halves, penalties, ball in play, and each robot's cards at the end."""
        parts = [str(self.names)] if self.names != SIDES_ALONE else []
        if not self.names.has_goals:
            return "; ".join(parts)
        parts += ["halves " + ", ".join(f"{score.cyan}:{score.magenta}" for score in self.halves)]
        if self.state.shoot_out is not None:
            parts.append(f"penalties {self.state.shoot_out.cyan}:{self.state.shoot_out.magenta}")
        parts.append(f"ball in play {self.state.effective:.1f} s")
        for name, one in self.state.robots.items():
            parts += [f"{name} {count} {card}" for card, count in (("yellow", one.yellow), ("red", one.red)) if count]
        return "; ".join(parts)

    def _table(self) -> Table:
        table = Table("clock", "event", "robot", "what", box=None, pad_edge=False)
        for event in self.events:
            if event.kind in NOTABLE:
                kind = event.kind.value.replace("_", " ")
                table.add_row(clock_text(event.clock), kind, event.robot or "", Text(self.names.in_text(event.text)))
        return table
