"""Plays one match in this process and measures it, tick by tick: no tick is kept."""

import signal
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
from touchline.matches.engine.child_processes import DiedProcessError, Poll
from touchline.matches.engine.hang_limit import HangLimit, HungError
from touchline.matches.engine.measurement import Measurement
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.play import InProcessMatch, RobotNotStartedError
from touchline.tick_messages import TickMessages

TRACEBACK = "traceback.txt"
"""The file with the traceback of a brain, in the folder of a match's logs."""
_OWN_SIGNALS = frozenset({signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGXCPU})
"""Signals with which a process is ended for what it did itself."""


class _WatchedMatch(InProcessMatch):
    """A match in which each robot has the whole time of the limit to be built."""

    def __init__(self, planned: PlannedMatch, limit: HangLimit) -> None:
        self._limit = limit
        self._is_built = False
        super().__init__(planned.config, brain_folder=planned.brain_folder)
        self._is_built = True

    @property
    def acting(self) -> str | None:
        """The robot whose brain is built or acts."""
        return self._limit.robot

    @acting.setter
    def acting(self, robot: str | None) -> None:
        self._limit.wait_for(robot)
        if not self._is_built:
            self._limit.restart()


def play_in_process(planned: PlannedMatch, poll: Poll = lambda: None) -> Outcome:
    """Play a match to its end; `poll` is called with each tick.

    A brain that raises, or does not answer for `hang_s` s of wall time, makes it a failed match.
    """
    limit = HangLimit(planned.hang_s)
    try:
        with limit:
            match = _WatchedMatch(planned, limit)
    except (RobotNotStartedError, HungError) as error:
        robot = error.robot if isinstance(error, RobotNotStartedError) else limit.robot
        reason = str(error) if isinstance(error, RobotNotStartedError) else f"{robot} is not built: {error}"
        evidence = written_traceback(planned, "".join(traceback.format_exception(error)))
        return Failed(planned.identity, FailureKind.DID_NOT_START, reason, side_of(planned, robot), evidence)
    except TouchlineError as error:
        return Failed(planned.identity, FailureKind.WORKER, str(error))

    def tick() -> None:
        limit.restart()
        poll()

    try:
        with limit:
            return _measured(planned, match, tick)
    except (Exception, SystemExit, HungError) as error:
        kind = FailureKind.HUNG if isinstance(error, HungError) else FailureKind.CRASHED
        evidence = written_traceback(planned, "".join(traceback.format_exception(error)))
        return Failed(planned.identity, kind, reason_of(match, error), side_of(planned, match.acting), evidence)
    finally:
        match.close()


def reason_of(match: InProcessMatch, error: BaseException) -> str:
    """One line for an exception in a match: robot, tick, file and line, as far as they are known."""
    who = f"{match.acting}, tick {match.simulation.now.tick}: " if match.acting is not None else ""
    kind = "" if isinstance(error, HungError) else f"{type(error).__name__}: "
    return f"{who}{kind}{' '.join(str(error).split())}{place_of(error)}"


def recording_of(planned: PlannedMatch, simulation: Simulation) -> AbstractContextManager[MatchRecording | None]:
    """The recording of a match that has just begun, if its plan names a file."""
    if planned.recording is None:
        return nullcontext()
    planned.recording.parent.mkdir(parents=True, exist_ok=True)
    return closing(MatchRecording(planned.recording, planned.config, simulation))


def outcome_of_death(planned: PlannedMatch, error: DiedProcessError) -> Failed:
    """The outcome of a match whose process has died.

    It is the fault of the robot that acted if the process did not answer, or ended itself. A process that was killed
    from outside is nobody's fault: the match can be played again.
    """
    robot, stack = error.note.doing, error.note.stack
    side = side_of(planned, robot)
    if side is None or not (stack or error.status > 0 or -error.status in _OWN_SIGNALS):
        return Failed(planned.identity, FailureKind.WORKER, str(error))
    kind = FailureKind.HUNG if stack else FailureKind.CRASHED
    reason = f"{robot}: no answer within {planned.hang_s:g} s" if stack else f"{robot}: {error}"
    return Failed(planned.identity, kind, reason, side, written_traceback(planned, stack or reason))


def written_traceback(planned: PlannedMatch, text: str) -> str | None:
    """The file with the traceback of a brain that raised, or that was interrupted; None if it is not to be kept."""
    if planned.logs is None:
        return None
    planned.logs.mkdir(parents=True, exist_ok=True)
    path = planned.logs / TRACEBACK
    path.write_text(text, "utf-8")
    return str(path)


def side_of(planned: PlannedMatch, robot: str | None) -> Side | None:
    """The side of a robot; None without one."""
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
