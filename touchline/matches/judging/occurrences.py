"""What happens in a scene, tick by tick, by the names that a drill uses."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from recordings.soccer.stats.kicks import SHOTS, KickOutcome, KickRecord, KickTracker
from recordings.soccer.stats.match_tick import MatchTick
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.soccer.game import EventKind


@dataclass(frozen=True, slots=True)
class Occurrence:
    """Something that happened; `name` is a key of `schemas.config.soccer.drill.OCCURRENCES`."""

    name: str
    time: float
    """Time in s since the start; of a pass, a shot and a save, that at which the outcome was clear."""
    robot: str | None = None
    """The robot that did it."""
    side: Side | None = None
    """The side of that robot."""

    def is_meant_by(self, occurred: str) -> bool:
        """Whether it is `goal`, `goal:cyan` or `touch:cyan2`."""
        name, _, who = occurred.partition(":")
        return name == self.name and who in ("", self.robot, self.side)

    def __str__(self) -> str:
        who = self.robot or self.side
        return f"{self.name}{f':{who}' if who else ''} after {self.time:.1f} s"


class OccurrenceTracker:
    """Finds what has happened in each tick."""

    def __init__(self, setup: Setup) -> None:
        self._kicks = KickTracker(setup)
        self._last: MatchTick | None = None

    @property
    def kicks(self) -> Sequence[KickRecord]:
        """All kicks with a clear outcome so far."""
        return self._kicks.kicks

    def update(self, tick: MatchTick) -> list[Occurrence]:
        """Add a tick; what has happened in it, in no particular order."""
        known = len(self._kicks.kicks)
        self._kicks.update(tick)
        return list(self._of_tick(tick, known))

    def end(self) -> list[Occurrence]:
        """Decide the open kick: the scene has ended."""
        known, last = len(self._kicks.kicks), self._last
        if last is None:
            return []
        self._kicks.end(last)
        return list(_of_kicks(self._kicks.kicks[known:], last))

    def _of_tick(self, tick: MatchTick, known: int) -> Iterator[Occurrence]:
        last, self._last = self._last, tick
        before = last.world if last is not None else None
        time, world = tick.world.time, tick.world
        for event in tick.events:
            if event.kind in _EVENTS:
                side = event.side or tick.side(event.robot)
                robot = event.robot if tick.side(event.robot) is side else None  # an own goal is nobody's
                yield Occurrence(_EVENTS[event.kind], time, robot, side)
        for name in dict.fromkeys(world.touches):
            if before is None or name not in before.touches:
                yield Occurrence("touch", time, name, tick.side(name))
        if world.possession is not None and (before is None or before.possession != world.possession):
            yield Occurrence("held_by", time, world.possession, tick.side(world.possession))
        if world.kicked is not None:
            yield Occurrence("kick", time, world.kicked, tick.side(world.kicked))
        yield from _of_kicks(self._kicks.kicks[known:], tick)


_EVENTS = {
    EventKind.GOAL: "goal",
    EventKind.BALL_OUT: "ball_out",
    EventKind.FOUL: "foul",
    EventKind.CARD: "card",
    EventKind.STOP: "stop",
    EventKind.IN_PLAY: "in_play",
}
"""Event of the referee → its name."""

_By = Callable[[KickRecord], str | None]
_KICKS: tuple[tuple[str, frozenset[KickOutcome], _By], ...] = (
    ("pass", frozenset({KickOutcome.RECEIVED}), lambda kick: kick.robot),
    ("shot", SHOTS, lambda kick: kick.robot),
    ("save", frozenset({KickOutcome.SAVED}), lambda kick: kick.by),
)
"""Name, the outcomes of a kick that it stands for, and the robot that did it."""


def _of_kicks(kicks: Iterable[KickRecord], tick: MatchTick) -> Iterator[Occurrence]:
    for kick in kicks:
        for name, outcomes, by in _KICKS:
            if kick.outcome in outcomes:
                yield Occurrence(name, tick.world.time, by(kick), tick.side(by(kick)))
