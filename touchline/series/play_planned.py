"""Plays one match of a series and measures it, tick by tick: no tick is kept."""

from collections.abc import Generator, Iterable, Iterator
from contextlib import AbstractContextManager, closing, nullcontext
from pathlib import Path
from typing import Any

from recordings.stats.match_statistics import MatchStatistics
from recordings.stats.match_tick import match_ticks
from robot_agent.user_code import place_of
from schemas.errors import TouchlineError
from touchline.match_recording import MatchRecording
from touchline.play import InProcessMatch
from touchline.series.match_row import FailedMatch, MatchRow, row_of
from touchline.series.plan import PlannedMatch
from touchline.series.processes import DiedProcess, Poll, run_in_processes
from touchline.tick_messages import TickMessages

Outcome = MatchRow | FailedMatch


def play_planned(planned: PlannedMatch, poll: Poll = lambda: None) -> Outcome:
    """Play a match to its end; `poll` is called with each tick. An exception of a brain makes it a failed match."""
    try:
        match = InProcessMatch(planned.config, brain_folder=planned.brain_folder)
    except TouchlineError as error:
        return failed(planned, str(error))
    try:
        return _measured(planned, match, poll)
    except (Exception, SystemExit) as error:
        return failed(planned, reason_of(match, error))
    finally:
        match.close()


def play_all(matches: Iterable[PlannedMatch], jobs: int) -> Generator[Outcome, None, None]:
    """Play matches in up to `jobs` processes at a time; yields each as it ends. Closing it ends the processes."""
    with closing(run_in_processes(play_planned, matches, jobs)) as results:
        for planned, result in results:
            yield failed(planned, result.reason) if isinstance(result, DiedProcess) else result


def failed(planned: PlannedMatch, reason: str) -> FailedMatch:
    """A failed match for this reason, one line."""
    return FailedMatch(planned.number, planned.identity, planned.seed, planned.swapped, reason)


def reason_of(match: InProcessMatch, error: BaseException) -> str:
    """One line for an exception in a match: robot, tick, file and line, as far as they are known."""
    who = f"{match.acting}, tick {match.simulation.now.tick}: " if match.acting is not None else ""
    return f"{who}{type(error).__name__}: {' '.join(str(error).split())}{place_of(error)}"


def _measured(planned: PlannedMatch, match: InProcessMatch, poll: Poll) -> MatchRow:
    setup, began = match.simulation.setup(), match.simulation.state.clock
    statistics = MatchStatistics(setup, 0.0, 0.0)
    with _recording(match, planned.recording) as recording:
        for tick in match_ticks(setup, _messages(match, recording, poll)):
            statistics.update(tick)
    playing_time = match.simulation.state.clock - began
    return row_of(planned, statistics.figures(), playing_time, match.simulation.now.applied["chain"])


def _messages(match: InProcessMatch, recording: MatchRecording | None, poll: Poll) -> Iterator[tuple[int, Any]]:
    messages = TickMessages(match.simulation)
    yield from messages.of(match.simulation.now)
    while not match.simulation.over:
        tick = match.step()
        if recording is not None:
            recording.add(tick, match.commands)
        yield from messages.of(tick)
        poll()


def _recording(match: InProcessMatch, path: Path | None) -> AbstractContextManager[MatchRecording | None]:
    """The recording of a match that has just begun, if a file is given."""
    if path is None:
        return nullcontext()
    path.parent.mkdir(parents=True, exist_ok=True)
    return closing(MatchRecording(path, match.simulation.config, match.simulation))
