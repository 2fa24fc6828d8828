"""`touchline replay --agent`: a brain in this process in place of one robot of a recorded match."""

import math
import sys
import traceback
from bdb import BdbQuit
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import typer

from recordings.reading.recording import Recording, open_recording
from recordings.replay.seek_targets import time_in
from robot_agent.loading.user_code import users_traceback
from schemas.errors import MatchFailedError, TouchlineError
from schemas.topics import APPLIED
from touchline.team.debugger.agent_report import AgentReport
from touchline.team.debugger.step_debugger import StepDebugger, examine
from touchline.verify.compare_brain import ComparisonSettings, FirstDifference, compare_brain, plainly


@dataclass(frozen=True, slots=True)
class AgentReplay:
    """The options of the command."""

    file: Path
    robot: str
    brain: str
    """`module:Class`."""
    start: str | None = None
    """Seconds, a tick, or an event; None for the first sight."""
    end: str | None = None
    """The same; None for the last one."""
    every_difference: bool = False
    """Go on after the first difference."""
    pdb: bool = False
    """Stop in Python's debugger: before `start`, or else before the first difference."""
    brain_folder: Path | None = None
    """Folder in which the brain's module is looked for before the current directory."""
    live: bool = False
    """Play on from `start` with this brain, in place of the comparison."""
    out: Path | None = None
    """With `live`: the recording to write of the whole match, its repeated part included."""
    json: bool = False
    """Print one JSON object; the brain's own output goes to stderr."""

    def run(self) -> int:
        """Carry out the command; returns its exit status.

        Raises:
            TouchlineError: wrong options, or a recording that cannot provide what they need.
            MatchFailedError: a brain failed.
        """
        if self.pdb and self.json:
            raise TouchlineError("--pdb is a dialogue, --json is for programs; leave one of them out")
        if self.live and self.every_difference:
            raise TouchlineError("--live compares no commands; leave --every-difference out")
        if self.out is not None and not self.live:
            raise TouchlineError("--out is the recording of a live match; give --live, too")
        recording = open_recording(self.file)
        start = time_in(self.start, recording) if self.start is not None else 0.0
        end = time_in(self.end, recording) if self.end is not None else math.inf
        if end < start:
            raise TouchlineError(f"--to {self.end} is before the beginning at {start:.2f} s; end later")
        report = AgentReport(recording, json=self.json)
        try:
            return (self._play_on if self.live else self._compare)(recording, start, end, report)
        except BdbQuit:
            typer.echo("the debugger was quit")
            return 0

    def _compare(self, recording: Recording, start: float, end: float, report: AgentReport) -> int:
        act = StepDebugger(start).act if self.pdb and self.start is not None else plainly
        settings = ComparisonSettings(
            start, end, not self.every_difference, act, report.show_difference, self.brain_folder
        )
        with self._brain_output():
            verdict = compare_brain(recording, self.robot, self.brain, settings)
        if not verdict.compared:
            raise TouchlineError(f"{self.robot} has answered no sight in this time; begin earlier")
        report.print_verdict(verdict)
        if verdict.first is None:
            return 0
        if self.pdb and self.start is None:
            self._stop_before(recording, verdict.first)
        elif not self.json:
            more = "; --every-difference goes on after it" if settings.first_only else ""
            typer.echo(f"--from tick:{verdict.first.tick} --pdb stops before it{more}")
        return 1

    def _stop_before(self, recording: Recording, first: FirstDifference) -> None:
        """Give the same sights to a new brain, and stop before its first different command."""
        moment = first.time
        typer.echo(f"a new brain receives the same sights; stopped before tick {first.tick}")
        with self._brain_output():
            again = compare_brain(
                recording,
                self.robot,
                self.brain,
                ComparisonSettings(moment, moment, act=StepDebugger(moment).act, brain_folder=self.brain_folder),
            )
        if again.first is None:
            typer.echo(
                f"this time its command is the recorded one: {self.brain} depends on more than its sights, such as "
                "random numbers, the time of day, or variables of its module"
            )

    def _play_on(self, recording: Recording, start: float, end: float, report: AgentReport) -> int:
        from touchline.team.debugger.live_match import LiveMatch  # needs PyBullet, unlike recorded sights

        if end == math.inf:
            end = max((channel.end for channel in recording.channels if channel.key == APPLIED.key), default=0.0)
        with self._brain_output():
            act = StepDebugger(start).act if self.pdb else plainly
            match = LiveMatch(recording, self.robot, self.brain, act, self.brain_folder, self.out)
            try:
                result = match.play(start, end, report.show_tick)
            finally:
                match.close()
        report.print_result(result, match.notes, self.out)
        return 0

    @contextmanager
    def _brain_output(self) -> Iterator[None]:
        """Keep what a brain prints apart from JSON, print where it fails, and open the debugger there."""
        with redirect_stdout(sys.stderr) if self.json else nullcontext():
            try:
                yield
            except MatchFailedError as error:
                if (cause := error.__cause__) is not None:
                    raised = users_traceback(cause)
                    typer.echo("".join(traceback.format_exception(type(cause), cause, raised)), err=True, nl=False)
                    if self.pdb:
                        examine(raised)
                raise


def parse_agent(text: str, on_the_bus: Mapping[str, object]) -> tuple[str, str]:
    """Robot and brain of `cyan2=module:Class`; the options in `on_the_bus` are not for a brain in this process.

    Raises:
        TouchlineError: it is written otherwise, or such an option is given.
    """
    robot, _, brain = text.partition("=")
    if not robot or not brain:
        raise TouchlineError(f'--agent is "{text}"; write it as cyan2=module:Class')
    if given := [option for option, value in on_the_bus.items() if value]:
        raise TouchlineError(f"--agent replays in this process, without a bus; leave {' and '.join(given)} out")
    return robot, brain
