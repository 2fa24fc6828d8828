"""Plays a match in one process: brains in Python and stdio programs, which are trusted not to touch each other."""

import traceback
from collections.abc import Callable, Iterator
from contextlib import closing
from typing import Any

from recordings.reading.recording import Recording
from recordings.stats.figures import MatchFigures
from recordings.stats.match_statistics import MatchStatistics, figures_of_recording
from recordings.stats.match_tick import match_ticks
from robot_agent.contract import Briefing
from robot_agent.robot_code import end_robot, start_robot
from robot_agent.user_code import place_of
from schemas.game import Card
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.topics import APPLIED
from touchline.match_recording import MatchRecording
from touchline.play import InProcessMatch
from touchline.tick_messages import TickMessages
from touchline.tournament.playing.hang_watch import Acting, HangWatch
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.planned_match import PlannedMatch

Poll = Callable[[], None]
Report = Callable[[Outcome], None]


class _Unbuilt:
    """Stands in for a robot until its brain is built."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


def play_in_process(planned: PlannedMatch, patience: float, report: Report, poll: Poll) -> None:
    """Play a match and report its outcome; `poll` is called with each tick.

    Where a robot takes longer than `patience`, in s of wall time, for a decision or to be built, another thread
    reports the outcome and ends the process.
    """
    played = _PlayedMatch(planned)

    def hung(acting: Acting, stack: str) -> None:
        when = "to be built" if acting.tick < 0 else f"for its decision at tick {acting.tick}"
        report(played.failed(FailureKind.HUNG, f"{acting.robot} took more than {patience:g} s {when}", stack))

    watch = HangWatch(patience, lambda: played.acting, hung)
    try:
        outcome = played.play(poll)
    finally:
        watch.stop()
        played.close()
    report(outcome)


class _PlayedMatch:
    """One match from the building of its brains to its outcome."""

    def __init__(self, planned: PlannedMatch) -> None:
        config = planned.config
        self._planned = planned
        self._sides = {name: side for side in Side for name in config.robots(side)}
        self._match = InProcessMatch(config, {name: _Unbuilt() for name in self._sides})
        self._is_built = False

    def close(self) -> None:
        """End the programs of robots, and free the engine."""
        for brain in self._match.brains.values():
            end_robot(brain)
        self._match.close()

    @property
    def acting(self) -> Acting:
        """The robot that decides or is built now."""
        return Acting(self._match.acting, self._match.simulation.now.tick if self._is_built else -1)

    def play(self, poll: Poll) -> Outcome:
        """Build the brains and play the match; what users' code raises becomes a failure of its side."""
        try:
            self._build(poll)
        except (Exception, SystemExit) as error:
            return self._blamed(FailureKind.DID_NOT_START, error)
        try:
            figures = self._play(poll)
        except (Exception, SystemExit) as error:
            return self._blamed(FailureKind.CRASHED, error)
        return outcome_of(figures, self._match.simulation.now.applied["chain"])

    def failed(self, kind: FailureKind, reason: str, evidence: str) -> Outcome:
        """A failure of the robot that acts, whose evidence is kept in a file."""
        robot = self._match.acting
        if robot is None:
            return Outcome.failed(FailureKind.WORKER, None, reason)
        self._planned.evidence.mkdir(parents=True, exist_ok=True)
        (self._planned.evidence / f"{robot}.log").write_text(evidence, "utf-8")
        return Outcome.failed(kind, self._sides[robot], reason)

    def _build(self, poll: Poll) -> None:
        setup, config = self._match.simulation.setup(), self._planned.config
        for robot, side in self._sides.items():
            self._match.acting = robot
            team, briefing = config.team(side), Briefing.of(robot, setup)
            self._match.brains[robot] = start_robot(team.brain or "", team.stdio, briefing, self._planned.code_folder)
            poll()
        self._match.acting, self._is_built = None, True

    def _blamed(self, kind: FailureKind, error: BaseException) -> Outcome:
        what = f"{type(error).__name__}: {error}{place_of(error)}"
        where = (
            f"{self._match.acting}, tick {self._match.simulation.now.tick}" if self._is_built else self._match.acting
        )
        return self.failed(kind, f"{where}: {what}", "".join(traceback.format_exception(error)))

    def _play(self, poll: Poll) -> MatchFigures:
        path, simulation = self._planned.recording, self._match.simulation
        path.parent.mkdir(parents=True, exist_ok=True)
        path.unlink(missing_ok=True)  # of an attempt that was cut short
        statistics = MatchStatistics(simulation.setup(), 0.0, 0.0)
        with closing(MatchRecording(path, simulation.config, simulation)) as recording:
            for tick in match_ticks(simulation.setup(), self._messages(recording, poll)):
                statistics.update(tick)
        return statistics.figures()

    def _messages(self, recording: MatchRecording, poll: Poll) -> Iterator[tuple[int, Any]]:
        messages = TickMessages(self._match.simulation)
        yield from messages.of(self._match.simulation.now)
        while not self._match.simulation.over:
            tick = self._match.step()
            recording.add(tick, self._match.commands)
            yield from messages.of(tick)
            poll()


def outcome_of(figures: MatchFigures, chain: str | None) -> Outcome:
    """The outcome of a match that was played to its end."""
    cyan, magenta = (figures.sides[side] for side in Side)
    penalties = (cyan.shoot_out, magenta.shoot_out or 0) if cyan.shoot_out is not None else None
    yellows, reds = ((cyan.cards.get(card, 0), magenta.cards.get(card, 0)) for card in (Card.YELLOW, Card.RED))
    return Outcome((cyan.goals or 0, magenta.goals or 0), penalties, yellows, reds, chain)


def recorded_outcome(recording: Recording) -> Outcome:
    """The outcome that a recording has.

    Raises:
        TouchlineError: the recording is damaged.
    """
    chain = None
    for _, applied in recording.decoded(APPLIED.key):
        chain = applied.chain
    return outcome_of(figures_of_recording(recording), chain)
