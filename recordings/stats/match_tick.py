"""One tick of a recording with all that belongs to it: the world, the game's state before and after, inputs, events."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from operator import itemgetter
from typing import Any

from recordings.container.lineup import Lineup
from schemas.game import GameEvent, GameState, Phase
from schemas.messages.command import Kick
from schemas.messages.host import Applied, Setup
from schemas.messages.world import World
from schemas.side import Side
from schemas.topics import APPLIED, EVENT, STATE, WORLD

KEYS = (WORLD.key, APPLIED.key, STATE.key, EVENT.key)
"""Of the messages that ticks are made of."""

GAP = 1.0
"""s; ours: what was played in a longer one, while the recorder was paused or cut off, is not known."""


@dataclass(frozen=True, slots=True)
class MatchTick:
    """What one tick brought; lengths in m, times in s of simulated time, in the field frame."""

    world: World
    before: World | None
    """The world of the tick before; nothing at the first one, after a `GAP`, and where the world was set up anew."""
    state: GameState | None
    """The game after this tick."""
    state_before: GameState | None
    """The game while this tick was played."""
    lineup: Lineup
    events: tuple[GameEvent, ...] = ()
    placed: frozenset[str] = frozenset()
    """Bodies that were set down by hand before this tick."""
    kick: Kick | None = None
    """What the robot whose kick was carried out had asked for."""

    @property
    def dt(self) -> float:
        """s since the tick before; more than one tick where some are missing."""
        return self.world.time - self.before.time if self.before is not None else 0.0

    @property
    def running(self) -> bool:
        """While this tick was played, START had been given and no STOP."""
        return self.state_before is not None and self.state_before.running

    @property
    def in_play(self) -> bool:
        """While this tick was played, the ball was in play: released by whoever took the restart, and no STOP yet."""
        return self.running and self.state_before is not None and self.state_before.phase is Phase.PLAY

    def side(self, robot: str | None) -> Side | None:
        """Whose robot it is; nothing for one that nobody ever named."""
        return self.lineup.side(robot) if robot is not None else None

    def keeps(self, robot: str) -> bool:
        """Whether a robot keeps its side's goal: its goalkeeper, or who stands in for one off the field."""
        there = [name for name, truth in self.world.robots.items() if truth.off_field is None]
        return self.lineup.keeps(robot, there)

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""
        return side.attack(self.state_before.cyan_attacks if self.state_before is not None else 1)


def match_ticks(setup: Setup, messages: Iterable[tuple[int, Any]]) -> Iterator[MatchTick]:
    """Log time and message of the keys of `KEYS`, in the order of a recording, as ticks.

    A tick whose world is missing, or not newer than the one before, gives no tick; what was said in it belongs to the
    next that has one.
    """
    lineup, state, before = Lineup.of(setup), None, None
    events: list[GameEvent] = []
    placed: set[str] = set()
    newest: GameState | None = None
    for _, together in groupby(messages, key=itemgetter(0)):
        world: World | None = None
        applied: Applied | None = None
        for _, message in together:
            match message:
                case World():
                    world = message
                case Applied():
                    applied = message
                case GameState():
                    newest = message
                case GameEvent():
                    events.append(message)
        if applied is not None:
            placed.update(placement.body for placement in applied.placements)
            if applied.robots is not None:
                lineup = lineup.changed(applied.robots)
        if world is None or (before is not None and world.time <= before.time):
            continue
        if before is not None and (world.episode != before.episode or world.time - before.time > GAP):
            before = None
        yield MatchTick(world, before, newest, state, lineup, tuple(events), frozenset(placed), _kick(world, applied))
        before, state, events = world, newest, []
        placed.clear()


def _kick(world: World, applied: Applied | None) -> Kick | None:
    if world.kicked is None or applied is None or world.kicked not in applied.inputs:
        return None
    return applied.inputs[world.kicked].kick
