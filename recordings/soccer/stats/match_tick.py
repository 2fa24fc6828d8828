"""One tick of a recording: the world, the game state before and after, inputs, events."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import groupby
from operator import itemgetter
from typing import Any

from recordings.container.lineup import Lineup
from schemas.messages.applied import Applied
from schemas.messages.command import Kick
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import Phase
from schemas.topics import APPLIED, EVENT, STATE, WORLD

KEYS = (WORLD.key, APPLIED.key, STATE.key, EVENT.key)
"""Keys of the messages that make up a tick."""

GAP = 1.0
"""s without a world after which the ticks are not consecutive: messages were lost."""


@dataclass(frozen=True, slots=True)
class MatchTick:
    """One tick; lengths in m, times in s of simulated time, in the field frame."""

    world: World
    before: World | None
    """The world of the tick before; None at the first tick, after a `GAP`, and in a new episode."""
    state: GameState | None
    """The game state after this tick."""
    state_before: GameState | None
    """The game state during this tick."""
    lineup: Lineup
    events: tuple[GameEvent, ...] = ()
    placed: frozenset[str] = frozenset()
    """Bodies that were placed by hand before this tick."""
    kick: Kick | None = None
    """The commanded kick of the robot whose kick was carried out."""
    chain: str | None = None
    """The hash chain after this tick; None if its inputs are missing."""

    @property
    def dt(self) -> float:
        """Time in s since the tick before; more than the duration of a tick if some are missing."""
        return self.world.time - self.before.time if self.before is not None else 0.0

    @property
    def running(self) -> bool:
        """Whether play was started and not stopped during this tick."""
        return self.state_before is not None and self.state_before.running

    @property
    def in_play(self) -> bool:
        """Whether the ball was in play during this tick: released after a restart, and not stopped."""
        return self.running and self.state_before is not None and self.state_before.phase is Phase.PLAY

    def side(self, robot: str | None) -> Side | None:
        """The side of a robot; None for an unknown robot."""
        return self.lineup.side(robot) if robot is not None else None

    def keeps(self, robot: str) -> bool:
        """Whether a robot keeps its side's goal: the goalkeeper, or its substitute while it is off the field."""
        on_field = [name for name, truth in self.world.robots.items() if truth.off_field is None]
        return self.lineup.keeps(robot, on_field)

    def attack(self, side: Side) -> int:
        """Sign of the x direction in which a side attacks."""
        return side.attack(self.state_before.cyan_attacks if self.state_before is not None else 1)


def match_ticks(setup: Setup, messages: Iterable[tuple[int, Any]]) -> Iterator[MatchTick]:
    """Join messages of the keys `KEYS`, given with their log times in recorded order, to ticks.

    A tick whose world is missing, or not newer than the one before, is left out; its other messages count for the next
    tick, and messages after the last world for the last tick.
    """
    lineup, state, before = Lineup.of(setup), None, None
    events: list[GameEvent] = []
    placed: set[str] = set()
    newest: GameState | None = None
    last: MatchTick | None = None
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
        if last is not None:
            yield last
        chain, kick = (applied.chain, _kick(world, applied)) if applied is not None else (None, None)
        last = MatchTick(world, before, newest, state, lineup, tuple(events), frozenset(placed), kick, chain)
        before, state, events = world, newest, []
        placed.clear()
    if last is not None:
        yield replace(last, state=newest, events=(*last.events, *events))


def _kick(world: World, applied: Applied) -> Kick | None:
    if world.kicked is None or world.kicked not in applied.inputs:
        return None
    return applied.inputs[world.kicked].kick
