"""Plays one match in this process and measures it, tick by tick: no tick is kept."""

import signal
import traceback
from contextlib import AbstractContextManager, closing, nullcontext
from dataclasses import replace
from pathlib import Path

from robot_agent.loading.user_code import place_of, sentence_of
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.match.simulation import Simulation
from touchline.matches.engine.fresh_process import DiedProcessError
from touchline.matches.engine.hang_watch import HangWatch
from touchline.matches.engine.measurement import Measurement
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.tick_messages import played_ticks
from touchline.matches.judging.judge import verdict_of
from touchline.matches.judging.occurrences import OccurrenceTracker
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch, RobotNotStartedError

TRACEBACK = "traceback.txt"
"""The file with the traceback of a brain, in the folder of a match's logs."""
_OWN_SIGNALS = frozenset({signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGXCPU})
"""Signals with which a process is ended for what it did itself."""
_UNKNOWN_STATUS = 255
"""What multiprocessing takes for the status of a process whose end two of its threads notice at the same time."""


class _WatchedMatch(InProcessMatch):
    """A match that tells the watch who acts."""

    def __init__(self, planned: PlannedMatch, watch: HangWatch) -> None:
        self._watch = watch
        self._is_built = False
        super().__init__(planned.config, brain_folder=planned.brain_folder)
        self._is_built = True

    @property
    def acting(self) -> str | None:
        """The robot whose brain is built or acts."""
        return self._acting

    @acting.setter
    def acting(self, robot: str | None) -> None:
        self._acting = robot
        self._watch.note(robot, is_built=self._is_built)


def play_in_process(planned: PlannedMatch, watch: HangWatch) -> Outcome:
    """Play a match to its end. A brain that raises makes it a failed match; one that hangs ends a watched process."""
    try:
        match = _WatchedMatch(planned, watch)
    except RobotNotStartedError as error:
        evidence = written_traceback(planned, "".join(traceback.format_exception(error)))
        sides = sides_of(planned, error.robot)
        return Failed(planned.identity, FailureKind.DID_NOT_START, str(error), sides, evidence)
    except TouchlineError as error:
        return Failed(planned.identity, FailureKind.WORKER, str(error))
    try:
        return _measured(planned, match)
    except (Exception, SystemExit) as error:
        evidence = written_traceback(planned, "".join(traceback.format_exception(error)))
        sides = sides_of(planned, match.acting)
        return Failed(planned.identity, FailureKind.CRASHED, reason_of(match, error), sides, evidence)
    finally:
        match.close()


def why_not_built(planned: PlannedMatch, note: Path | None = None) -> str:
    """Why the robots of a match cannot be built; empty if they can. One that hangs ends this process, with a note."""
    with closing(HangWatch(note, planned.hang_s, planned.config.patience.attendance)) as watch:
        try:
            _WatchedMatch(planned, watch).close()
        except TouchlineError as error:
            return str(error)
    return ""


def reason_of(match: InProcessMatch, error: BaseException) -> str:
    """One line for an exception in a match: robot, tick, file and line, as far as they are known."""
    if match.acting is None and isinstance(error, TouchlineError):
        return str(error)  # of the score of a free game
    who = f"{match.acting}, tick {match.simulation.now.tick}: " if match.acting is not None else ""
    return f"{who}{sentence_of(error)}{place_of(error)}"


def recording_of(planned: PlannedMatch, simulation: Simulation) -> AbstractContextManager[MatchRecording | None]:
    """The recording of a match that has just begun, if its plan names a file."""
    if planned.recording is None:
        return nullcontext()
    return closing(MatchRecording(planned.recording, planned.config, simulation))


def outcome_of_death(planned: PlannedMatch, error: DiedProcessError) -> Failed:
    """The outcome of a match whose process has died.

    It is the fault of the robot that acted if the process did not answer, or ended itself. A process that was killed
    from outside, or that was slow while no brain had control, is nobody's fault: the match can be played again.
    """
    robot, stack = error.note.acting, error.note.stack
    sides = sides_of(planned, robot)
    ended_itself = 0 <= error.status < _UNKNOWN_STATUS or -error.status in _OWN_SIGNALS
    if not sides or not (stack or ended_itself):
        return Failed(planned.identity, FailureKind.WORKER, str(error))
    if not stack:
        kind, reason = FailureKind.CRASHED, f"{robot}: {error}"
    elif error.note.is_built:
        kind, reason = FailureKind.HUNG, f"{robot}: no answer within {error.note.limit_s:g} s"
    else:
        kind, reason = FailureKind.DID_NOT_START, f"{robot} is not built: no answer within {error.note.limit_s:g} s"
    return Failed(planned.identity, kind, reason, sides, written_traceback(planned, stack or reason))


def written_traceback(planned: PlannedMatch, text: str) -> str | None:
    """The file with the traceback of a brain that raised, or that was interrupted; None if it is not to be kept."""
    if planned.logs is None:
        return None
    planned.logs.mkdir(parents=True, exist_ok=True)
    path = planned.logs / TRACEBACK
    path.write_text(text, "utf-8")
    return str(path)


def sides_of(planned: PlannedMatch, robot: str | None) -> tuple[Side, ...]:
    """The side of a robot; none without one."""
    return tuple(side for side in Side if robot in planned.config.robots(side))


def _measured(planned: PlannedMatch, match: _WatchedMatch) -> Played:
    setup, scene = match.simulation.setup(), planned.config.scene
    measurement = Measurement(setup)
    drill = scene.drill if scene is not None and planned.is_drill else None
    tracker, verdict = OccurrenceTracker(setup), None
    with recording_of(planned, match.simulation) as recording:
        record = (lambda tick: recording.add(tick, match.commands)) if recording is not None else (lambda _: None)
        for tick in played_ticks(match, record):
            measurement.update(tick)
            if drill is not None:
                verdict = verdict_of(drill, tick.world.time, tracker.update(tick))
            if verdict is not None:
                break
    return replace(measurement.played(planned.identity, planned.recording), verdict=verdict)
