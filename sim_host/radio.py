"""The air between teammates: what a robot says reaches each teammate late, or not at all, within the byte budget."""

import math
from collections import deque
from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush

from schemas.command import Radio
from schemas.sections import Radio as Air
from schemas.side import Side
from sim_host.sensing.streams import Block, Streams, What
from sim_host.snapshot import Roster

_WINDOW_S = 1.0
"""The budget counts what a team said in the last second."""

_EMPTY = b"{}"
_WORD = Radio.__pydantic_serializer__

_SAME = 1e-6
"""Ticks; a delay that exceeds whole ticks by no more is these ticks, for all that floats round."""


@dataclass(frozen=True, slots=True)
class _Word:
    said: int
    """Tick."""
    opened: bytes
    """The speaker's name and its word as JSON, left open for the age: written once, heard by all in every tick."""


@dataclass(slots=True)
class _TeamAir:
    said: deque[tuple[int, int]] = field(default_factory=deque)
    """(tick, bits) of each word of the last second."""
    bits: int = 0


class RadioAir:
    """The radio of both teams.

    A word takes `delay` and a share of `jitter`, uniform and different for each listener, and is heard at the first
    tick after that. So a word can overtake another; a listener keeps the one that was said last.
    """

    def __init__(self, air: Air, roster: Roster, tick: float, streams: Streams) -> None:
        self._air = air
        self._roster = roster
        self._tick_s = tick
        self._streams = streams
        names = roster.names
        self._luck = Block(lambda ticks: streams.between(What.AIR, names, names, ticks))
        """Per tick: speaker × listener × (loss, jitter, nothing, nothing)."""
        self._teams = {side: _TeamAir() for side in Side}
        self._under_way: list[tuple[int, int, int, int, _Word]] = []
        """A heap of (tick of arrival, tick it was said, speaker, listener, word), each of them once."""
        self._heard: list[dict[int, _Word]] = [{} for _ in roster.names]
        """Listener → speaker → word, in the order of the roster."""
        self._mates = [
            [other for other, side in enumerate(roster.sides) if side is mine and other != place]
            for place, mine in enumerate(roster.sides)
        ]

    def change(self, air: Air) -> None:
        """Another air for all words from now on; those under way arrive as they would have."""
        self._air = air

    def handed_on(self, roster: Roster) -> "RadioAir":
        """For other robots: what was said, is under way and was heard stays with those who stay on their side."""
        heir, before = RadioAir(self._air, roster, self._tick_s, self._streams), self._roster
        place = {
            old: roster.names.index(name)
            for old, name in enumerate(before.names)
            if name in roster.names and roster.side_of(name) is before.side_of(name)
        }
        heir._teams = self._teams
        heir._under_way = [
            (arrives, said, place[speaker], place[mate], word)
            for arrives, said, speaker, mate, word in self._under_way
            if speaker in place and mate in place
        ]
        heapify(heir._under_way)
        for old, new in place.items():
            heir._heard[new] = {place[speaker]: word for speaker, word in self._heard[old].items() if speaker in place}
        return heir

    def say(self, tick: int, speaker: str, word: Radio) -> str | None:
        """Send a word to all teammates; returns why it was refused, or nothing."""
        place = self._roster.names.index(speaker)
        said = _WORD.to_json(word, exclude_defaults=True)
        bits = 8 * len(said)
        team = self._teams[self._roster.sides[place]]
        self._forget(team, tick)
        if team.bits + bits > self._air.budget * _WINDOW_S:
            return f"radio: the team's budget of {self._air.budget / 1e6:g} Mbit/s is used up"
        team.said.append((tick, bits))
        team.bits += bits
        opened = said[:-1] + (b"," if len(said) > len(_EMPTY) else b"")
        self._send(place, _Word(tick, b'"%s":%s' % (speaker.encode(), opened)))
        return None

    def _send(self, speaker: int, word: _Word) -> None:
        """On its way to everyone who will hear it."""
        air, luck = self._air, self._luck.at(word.said)[speaker].tolist()
        for mate in self._mates[speaker]:
            lost, late, *_ = luck[mate]
            if lost >= air.loss:
                ticks = math.ceil((air.delay + late * air.jitter) / self._tick_s - _SAME)
                heappush(self._under_way, (word.said + ticks, word.said, speaker, mate, word))

    def listen(self, tick: int) -> list[bytes]:
        """What everybody has heard by this tick, as JSON: teammate → `schemas.sight.Heard`, the newest of each."""
        while self._under_way and self._under_way[0][0] <= tick:
            _, said, speaker, mate, word = heappop(self._under_way)
            before = self._heard[mate].get(speaker)
            if before is None or said > before.said:
                self._heard[mate][speaker] = word
        tick_s = self._tick_s
        return [
            b"{%s}"
            % b",".join([b'%s"age":%.4f}' % (word.opened, (tick - word.said) * tick_s) for word in heard.values()])
            for heard in self._heard
        ]

    def _forget(self, team: _TeamAir, tick: int) -> None:
        oldest = tick - _WINDOW_S / self._tick_s
        while team.said and team.said[0][0] <= oldest:
            team.bits -= team.said.popleft()[1]
