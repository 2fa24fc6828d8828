"""Computes all figures of a recording in one pass."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from recordings.container.lineup import Lineup
from recordings.reading.recording import Recording
from recordings.soccer.league import IMPORTER
from recordings.soccer.stats.ball_control import BallControl
from recordings.soccer.stats.crowding import Crowding
from recordings.soccer.stats.dribbles import DribbleStats, DribbleTracker
from recordings.soccer.stats.figures import Coverage, KickCounts, MatchFigures, RobotFigures, SideFigures
from recordings.soccer.stats.kicks import KickOutcome, KickRecord, KickTracker
from recordings.soccer.stats.match_tick import GAP, KEYS, MatchTick, match_ticks
from recordings.soccer.stats.momentum import Momentum
from recordings.soccer.stats.motion import MotionTracker
from recordings.soccer.stats.referee_calls import RefereeCalls
from schemas.config.task import GameName
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import Card

MAX_TIME_DIFFERENCE_S = 1.0
"""s between the time in a world and its log time; with a larger difference the world is invalid. Chosen here."""


def match_ticks_of(recording: Recording) -> Iterator[MatchTick]:
    """Yield the ticks of a recording, in order; worlds with an impossible time count as unreadable.

    Raises:
        TouchlineError: the file is damaged inside, or has no setup.
    """
    return match_ticks(recording.setup, _messages(recording))


def _messages(recording: Recording) -> Iterator[tuple[int, Any]]:
    for recorded, message in recording.decoded(*KEYS):
        if isinstance(message, World) and abs(message.time - recorded.time) > MAX_TIME_DIFFERENCE_S:
            recording.unreadable[recorded.key] += 1
        else:
            yield recorded.log_ns, message


TickObserver = Callable[[MatchTick], None]
"""Is called with each tick."""


class MatchStatistics:
    """Accumulates the figures of a match, tick by tick."""

    def __init__(self, setup: Setup, start: float, end: float) -> None:
        """`start` and `end` are in s of simulated time.

        Raises:
            TouchlineError: another game than soccer is played.
        """
        if setup.game is not GameName.SOCCER:
            raise TouchlineError(f'the match is of the game "{setup.game}", and these figures are of soccer')
        self._setup = setup
        self._control = BallControl()
        self._crowding = Crowding()
        self._motions = MotionTracker()
        self._dribbles = DribbleTracker()
        self._kicks = KickTracker(setup)
        self._calls = RefereeCalls()
        self._observers: tuple[TickObserver, ...] = (
            self._control.update,
            self._crowding.update,
            self._motions.update,
            self._dribbles.update,
            self._kicks.update,
            self._calls.update,
        )
        self._momentum = Momentum(start, end, setup.pitch.goal_line)
        self._coverage = Coverage()
        self._first: MatchTick | None = None
        self._last: MatchTick | None = None

    def update(self, match_tick: MatchTick) -> None:
        """Add a tick."""
        self._momentum.update(match_tick, self._control.side)
        for observe in self._observers:
            observe(match_tick)
        world, coverage = match_tick.world, self._coverage
        coverage.worlds += 1
        coverage.touched += bool(world.touches)
        coverage.held += world.possession is not None
        coverage.states += match_tick.state is not match_tick.state_before
        step = world.time - self._last.world.time if self._last is not None else 0.0
        coverage.missing += step if step > GAP else 0.0
        self._first = self._first or match_tick
        self._last = match_tick

    def figures(self, unreadable: int = 0) -> MatchFigures:
        """Return the figures; `unreadable` is the number of messages that could not be decoded.

        Raises:
            TouchlineError: no tick was added.
        """
        if self._first is None or self._last is None:
            raise TouchlineError("no world could be read, so there is nothing to measure")
        self._dribbles.end()
        self._kicks.end(self._last)
        coverage, lineup = self._coverage, self._last.lineup
        coverage.kicks, coverage.events = len(self._kicks.kicks), len(self._calls.events)
        coverage.unreadable = unreadable
        duration = self._last.world.time - self._first.world.time
        in_play = self._control.in_play if coverage.states else None
        controlled = sum(self._control.seconds.values())
        return MatchFigures(
            match=self._setup.match,
            start=self._first.world.time,
            duration=duration,
            in_play_s=in_play,
            in_play=in_play / duration if in_play is not None and duration > 0 else None,
            free_s=max(0.0, in_play - controlled) if in_play is not None and self._knows_ball else None,
            crowded_s=self._crowding.seconds if coverage.states else None,
            longest_crowd_s=self._crowding.longest if coverage.states else None,
            drop_balls=sum(count for (side, _), count in self._calls.restarts.items() if side is None),
            sides={side: self._side(side, lineup) for side in Side},
            robots=[
                self._robot(name, lineup)
                for name in dict.fromkeys([*lineup.robots, *self._motions.robots])
                if name in self._motions.robots
            ],
            goals=self._calls.goals,
            kicks=self._kicks.kicks,
            momentum_width=self._momentum.width,
            momentum=self._momentum.values(),
            coverage=coverage,
            events=self._calls.events,
        )

    @property
    def _knows_ball(self) -> bool:
        """Whether possession is known: game states are recorded, and touches or holds of the ball."""
        return bool(self._coverage.states and (self._coverage.touched or self._coverage.held))

    @property
    def _knows_kicks(self) -> bool:
        """Whether outcomes of kicks are known: game states and touches are recorded."""
        return bool(self._coverage.states and self._coverage.touched)

    def _side(self, side: Side, lineup: Lineup) -> SideFigures:
        """The figures of one side, with the name of its team."""
        teams, held = self._setup.teams, self._coverage.held
        names = [name for name in self._motions.robots if lineup.side(name) is side]
        motions = [self._motions.robots[name] for name in names]
        dribbles = [self._dribbles.robots[name] for name in names if name in self._dribbles.robots]
        in_play = sum(motion.in_play for motion in motions)
        in_play_distance = sum(motion.in_play_distance for motion in motions)
        controlled, score, shoot_out = sum(self._control.seconds.values()), self._calls.score, self._calls.shoot_out
        return SideFigures(
            team=teams[side].name if side in teams else side.value,
            goals=score.of(side) if score is not None else None,
            shoot_out=shoot_out.of(side) if shoot_out is not None else None,
            possession=self._control.seconds[side] / controlled if controlled > 0 else None,
            possession_s=self._control.seconds[side] if self._knows_ball else None,
            with_ball_s=sum(self._control.with_ball.get(name, 0.0) for name in names) if held else None,
            kicks=self._counted([kick for kick in self._kicks.kicks if kick.side is side]),
            saves=self._saves(names),
            dribbles=sum(one.count for one in dribbles) if held else None,
            dribbled=sum(one.distance for one in dribbles) if held else None,
            distance=sum(motion.distance for motion in motions),
            in_play_distance=in_play_distance,
            top_speed=max((motion.top_speed for motion in motions), default=0.0),
            mean_speed=in_play_distance / in_play if in_play > 0 else None,
            fouls={rule: count for (of, rule), count in self._calls.fouls.items() if of is side},
            cards={card.value: self._calls.cards[side, card] for card in Card},
            restarts={phase.value: count for (of, phase), count in self._calls.restarts.items() if of is side},
        )

    def _robot(self, name: str, lineup: Lineup) -> RobotFigures:
        """The figures of one robot."""
        motion, side = self._motions.robots[name], lineup.side(name)
        dribbles = self._dribbles.robots.get(name, DribbleStats())
        held = self._coverage.held
        goals = sum(goal.robot == name and goal.side is side for goal in self._calls.goals)
        return RobotFigures(
            name=name,
            side=side.value if side is not None else None,
            keeper=lineup.is_keeper(name),
            distance=motion.distance,
            clock_distance=motion.clock_distance,
            in_play_distance=motion.in_play_distance,
            top_speed=motion.top_speed,
            mean_speed=motion.mean_speed if motion.in_play > 0 else None,
            longest_stuck_s=motion.longest_stuck,
            with_ball_s=self._control.with_ball.get(name, 0.0) if held else None,
            kicks=self._counted([kick for kick in self._kicks.kicks if kick.robot == name]),
            saves=self._saves([name]),
            dribbles=dribbles.count if held else None,
            dribbled=dribbles.distance if held else None,
            longest_dribble=dribbles.longest if held else None,
            goals=goals if self._coverage.events else None,
            fouls=self._calls.fouls_of[name],
            cards={card.value: self._calls.cards_of[name, card] for card in Card},
        )

    def _counted(self, kicks: list[KickRecord]) -> KickCounts | None:
        return KickCounts.of(kicks) if self._knows_kicks else None

    def _saves(self, names: Sequence[str]) -> int | None:
        if not self._knows_kicks:
            return None
        return sum(kick.outcome is KickOutcome.SAVED and kick.by in names for kick in self._kicks.kicks)


def figures_of_recording(recording: Recording, *observers: TickObserver) -> MatchFigures:
    """The figures of a recording; `observers` are updated with the same ticks, in the same pass.

    Raises:
        TouchlineError: the recording is damaged inside, or has no setup or no world.
    """
    setup, (start, end) = recording.setup, recording.extent_of_worlds()
    statistics, before = MatchStatistics(setup, start, end), recording.unreadable.total()
    for match_tick in match_ticks_of(recording):
        statistics.update(match_tick)
        for other in observers:
            other(match_tick)
    figures = statistics.figures(recording.unreadable.total() - before)
    figures.coverage.inferred = recording.manifest.recorder == IMPORTER
    return figures
