"""What `touchline replay --agent` prints: a table of differences, the verdict, and what came of a live match."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from coach_gateway.match.lines import event_line
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from recordings.reading.recording import Recording
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import Phase
from schemas.topics import EVENT, STATE
from touchline.launch.terminal.json_text import json_text
from touchline.verify.command_difference import FieldDifference
from touchline.verify.compare_brain import BrainComparison

if TYPE_CHECKING:
    from sim_host.match.simulation import TickResult
    from touchline.team.debugger.live_match import LiveResult

_HEAD = f"{'tick':>6}  {'time':>9}  {'field':<22}{'recorded':<26}new"


class AgentReport:
    """Prints lines for people, or one JSON object at the end."""

    def __init__(self, recording: Recording, *, json: bool) -> None:
        setup = recording.manifest.setup
        self._recording = recording
        self._names = TeamNames.of_setup(setup) if setup is not None else SIDES_ALONE
        self._is_json = json
        self._has_head = False

    def show_difference(self, sight: Sight, found: list[FieldDifference]) -> None:
        """Print the rows of one command that differs."""
        if self._is_json:
            return
        if not self._has_head:
            typer.echo(_HEAD)
            self._has_head = True
        place = f"{sight.tick:>6}  {sight.time:>7.2f} s"
        for one in found:
            recorded, new = one.texts()
            typer.echo(f"{place:<17}  {one.field:<21} {recorded:<25} {new}")
            place = ""

    def print_verdict(self, verdict: BrainComparison) -> None:
        """Print the result of a comparison."""
        if self._is_json:
            typer.echo(json_text(verdict))
            return
        if verdict.earlier:
            typer.echo(f"{verdict.earlier} earlier sights were given to the brain for its state, without its output")
        typer.echo(verdict.sentence())

    def show_tick(self, tick: "TickResult") -> None:
        """Print the events of a live tick."""
        if not self._is_json:
            self._print_events(tick.events)

    def print_result(self, result: "LiveResult", notes: list[str], out: Path | None) -> None:
        """Print what came of a live match, recorded in `out`, and what was recorded in the same time."""
        recorded = self._recorded_state(result.end)
        if self._is_json:
            fields = {
                "start": result.start,
                "end": result.end,
                "score": result.state.score,
                "recorded_score": recorded.score,
                "events": result.events,
                "notes": notes,
            }
            if result.state.value is not None:
                fields |= {"value": result.state.value, "recorded_value": recorded.value}
            typer.echo(json_text(fields))
            return
        events = [event for _, event in self._recording.decoded(EVENT.key)]
        events = [event for event in events if result.start < event.time <= result.end]
        typer.echo("recorded in the same time:" if events else "recorded in the same time: no events")
        self._print_events(events)
        for note in notes:
            typer.echo(f"note: {note}")
        typer.echo(
            f"live from {result.start:.2f} s to {result.end:.2f} s: "
            f"{self._names.score(result.state.score, result.state.value)}; "
            f"recorded: {self._names.score(recorded.score, recorded.value)}"
        )
        if out is not None:
            typer.echo(f"recording {out}")

    def _print_events(self, events: Iterable[GameEvent]) -> None:
        for event in events:
            typer.echo(event_line(event, self._names))

    def _recorded_state(self, end: float) -> GameState:
        """The recorded game at a simulated time in s."""
        newest = GameState(tick=0, time=0.0, phase=Phase.STOPPED)
        for _, state in self._recording.decoded(STATE.key):
            if state.time <= end:
                newest = state
        return newest
