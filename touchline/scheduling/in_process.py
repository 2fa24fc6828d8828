"""Plays one match in this process and measures it, tick by tick: no tick is kept."""

import traceback
from collections.abc import Iterator
from contextlib import AbstractContextManager, closing, nullcontext
from typing import Any

from recordings.stats.match_tick import match_ticks
from robot_agent.user_code import place_of
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.match.simulation import Simulation
from touchline.match_recording import MatchRecording
from touchline.play import InProcessMatch, RobotNotStartedError
from touchline.scheduling.child_processes import Poll
from touchline.scheduling.hang_limit import HANG_S, HangLimit, HungError
from touchline.scheduling.measurement import Measurement
from touchline.scheduling.outcome import Failed, FailureKind, Outcome, Played
from touchline.scheduling.planned_match import PlannedMatch
from touchline.tick_messages import TickMessages

TRACEBACK = "traceback.txt"
"""The file with the traceback of a brain, in the folder of a match's logs."""


def play_in_process(planned: PlannedMatch, poll: Poll = lambda: None, hang_s: float = HANG_S) -> Outcome:
    """Play a match to its end; `poll` is called with each tick.

    A brain that raises, or does not answer for `hang_s` s of wall time, makes it a failed match.
    """
    limit = HangLimit(hang_s)
    try:
        with limit:
            match = InProcessMatch(planned.config, brain_folder=planned.brain_folder)
    except RobotNotStartedError as error:
        return Failed(planned.identity, FailureKind.DID_NOT_START, str(error), _side_of(planned, error.robot))
    except (TouchlineError, HungError) as error:
        return Failed(planned.identity, FailureKind.DID_NOT_START, str(error))

    def tick() -> None:
        limit.restart()
        poll()

    try:
        with limit:
            return _measured(planned, match, tick)
    except (Exception, SystemExit, HungError) as error:
        kind = FailureKind.HUNG if isinstance(error, HungError) else FailureKind.CRASHED
        evidence = _written_traceback(planned, error)
        return Failed(planned.identity, kind, reason_of(match, error), _side_of(planned, match.acting), evidence)
    finally:
        match.close()


def reason_of(match: InProcessMatch, error: BaseException) -> str:
    """One line for an exception in a match: robot, tick, file and line, as far as they are known."""
    who = f"{match.acting}, tick {match.simulation.now.tick}: " if match.acting is not None else ""
    return f"{who}{type(error).__name__}: {' '.join(str(error).split())}{place_of(error)}"


def recording_of(planned: PlannedMatch, simulation: Simulation) -> AbstractContextManager[MatchRecording | None]:
    """The recording of a match that has just begun, if its plan names a file."""
    if planned.recording is None:
        return nullcontext()
    planned.recording.parent.mkdir(parents=True, exist_ok=True)
    return closing(MatchRecording(planned.recording, planned.config, simulation))


def _written_traceback(planned: PlannedMatch, error: BaseException) -> str | None:
    """The file with the traceback of a brain that raised, or that was interrupted."""
    if planned.logs is None:
        return None
    planned.logs.mkdir(parents=True, exist_ok=True)
    path = planned.logs / TRACEBACK
    path.write_text("".join(traceback.format_exception(error)))
    return str(path)


def _side_of(planned: PlannedMatch, robot: str | None) -> Side | None:
    return next((side for side in Side if robot in planned.config.robots(side)), None)


def _measured(planned: PlannedMatch, match: InProcessMatch, poll: Poll) -> Played:
    setup = match.simulation.setup()
    measurement = Measurement(setup)
    with recording_of(planned, match.simulation) as recording:
        for tick in match_ticks(setup, _messages(match, recording, poll)):
            measurement.update(tick)
    return measurement.played(planned.identity, planned.recording)


def _messages(match: InProcessMatch, recording: MatchRecording | None, poll: Poll) -> Iterator[tuple[int, Any]]:
    messages = TickMessages(match.simulation)
    yield from messages.of(match.simulation.now)
    while not match.simulation.over:
        tick = match.step()
        if recording is not None:
            recording.add(tick, match.commands)
        yield from messages.of(tick)
        poll()
