"""The air between teammates: what a robot says reaches each teammate late, or not at all, within the byte budget."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from schemas.command import Radio
from schemas.light import beyond_defaults, light_encode_exactly
from schemas.sections import Radio as Air
from schemas.side import Side
from sim_host.sensing.streams import Block, Streams, What
from sim_host.snapshot import Roster

_WINDOW_S = 1.0
"""The budget counts what a team said in the last second."""

_EMPTY = b"{}"

Delays = NDArray[np.int64]
"""Ticks from each member of a team to each, shape (members, members)."""
_LOST = -1
"""In place of a delay in ticks: the word never arrives."""
_SAME = 1e-6
"""Ticks; a delay that exceeds whole ticks by no more is these ticks, for all that floats round."""


@dataclass(slots=True, eq=False)
class _Word:
    said: int
    """Tick."""
    opened: bytes
    """The speaker's name and its word as JSON, left open for the age: written once, heard by all in every tick."""


class _Ages(dict[int, bytes]):
    """Tick → how long ago that is in one tick, as the end of a word: many words are of the same age."""

    def __init__(self, tick: int, tick_s: float) -> None:
        self._tick = tick
        self._tick_s = tick_s

    def __missing__(self, said: int) -> bytes:
        self[said] = text = b'"age":%.4f}' % ((self._tick - said) * self._tick_s)
        return text


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
        self._teams = {side: _TeamAir() for side in Side}
        self._under_way: dict[int, list[tuple[int, int, _Word]]] = {}
        """Tick of arrival → speaker, listener and word, in the order in which they were said."""
        self._heard: list[dict[int, _Word]] = [{} for _ in roster.names]
        """Listener → speaker → word, in the order of the roster."""
        self._members = {side: [place for place, its in enumerate(roster.sides) if its is side] for side in Side}
        self._delays = self._new_delays()

    def change(self, air: Air) -> None:
        """Another air for all words from now on; those under way arrive as they would have."""
        self._air = air
        self._delays = self._new_delays()

    def handed_on(self, roster: Roster) -> "RadioAir":
        """For other robots: what was said, is under way and was heard stays with those who stay on their side."""
        heir, before = RadioAir(self._air, roster, self._tick_s, self._streams), self._roster
        place = {
            old: roster.names.index(name)
            for old, name in enumerate(before.names)
            if name in roster.names and roster.side_of(name) is before.side_of(name)
        }
        heir._teams = self._teams
        heir._under_way = {
            arrives: [
                (place[speaker], place[mate], word)
                for speaker, mate, word in words
                if speaker in place and mate in place
            ]
            for arrives, words in self._under_way.items()
        }
        for old, new in place.items():
            heir._heard[new] = {place[speaker]: word for speaker, word in self._heard[old].items() if speaker in place}
        return heir

    def say(self, tick: int, speaker: str, word: Radio) -> str | None:
        """Send a word, light or not, to all teammates; returns why it was refused, or nothing.

        What stands at its default is not sent, and takes nothing of the budget.
        """
        place = self._roster.names.index(speaker)
        said = light_encode_exactly(beyond_defaults(word))
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
        side = self._roster.sides[speaker]
        members = self._members[side]
        delays = self._delays[side].at(word.said)[members.index(speaker)].tolist()
        for mate, delay in zip(members, delays, strict=True):
            if mate != speaker and delay != _LOST:
                self._under_way.setdefault(word.said + delay, []).append((speaker, mate, word))

    def _new_delays(self) -> dict[Side, Block[Delays]]:
        """Per side and tick: for how many ticks a word of each member is under way to each member."""
        names = self._roster.names
        return {
            side: Block(partial(self._draw, [names[place] for place in members]))
            for side, members in self._members.items()
        }

    def _draw(self, names: Sequence[str], ticks: range) -> list[Delays]:
        air = self._air
        lost, late, *_ = np.moveaxis(self._streams.between(What.AIR, names, names, ticks), -1, 0)
        whole = np.ceil((air.delay + late * air.jitter) / self._tick_s - _SAME).astype(np.int64)
        return list(np.where(lost < air.loss, _LOST, whole))

    def listen(self, tick: int) -> list[bytes]:
        """What everybody has heard by this tick, as JSON: teammate → `schemas.sight.Heard`, the newest of each."""
        for arrives in sorted([one for one in self._under_way if one <= tick]):
            for speaker, mate, word in self._under_way.pop(arrives):
                before = self._heard[mate].get(speaker)
                if before is None or word.said > before.said:
                    self._heard[mate][speaker] = word
        ages = _Ages(tick, self._tick_s)
        return [
            b"{%b}" % b",".join([word.opened + ages[word.said] for word in heard.values()]) for heard in self._heard
        ]

    def _forget(self, team: _TeamAir, tick: int) -> None:
        oldest = tick - _WINDOW_S / self._tick_s
        while team.said and team.said[0][0] <= oldest:
            team.bits -= team.said.popleft()[1]
