"""The air between teammates: what a robot says reaches each teammate late, or not at all, within the byte budget."""

from collections import deque
from dataclasses import dataclass, field

from schemas.command import Radio
from schemas.profile import Radio as Air
from schemas.side import Side
from sim_host.sensing.streams import Block, Streams, What
from sim_host.snapshot import Roster

_WINDOW_S = 1.0
"""The budget counts what a team said in the last second."""

_EMPTY = b"{}"


@dataclass(frozen=True, slots=True)
class _Word:
    said: int
    """Tick."""
    arrives: int
    """Tick."""
    speaker: int
    opened: bytes
    """The speaker's name and its word as JSON, left open for the age: written once, heard by all in every tick."""


@dataclass(slots=True)
class _TeamAir:
    said: deque[tuple[int, int]] = field(default_factory=deque)
    """(tick, bits) of each word of the last second."""
    bits: int = 0


class RadioAir:
    """The radio of both teams."""

    def __init__(self, air: Air, roster: Roster, tick: float, streams: Streams) -> None:
        self._air = air
        self._roster = roster
        self._tick_s = tick
        self._delay = round(air.delay / tick)
        names = roster.names
        self._luck = Block(lambda ticks: streams.uniforms(What.RADIO, names, ticks, len(names)))
        """Per tick: speaker × listener."""
        self._teams = {side: _TeamAir() for side in Side}
        self._travelling: deque[_Word] = deque()
        self._heard: list[dict[int, _Word]] = [{} for _ in roster.names]
        self._mates = [
            [other for other, side in enumerate(roster.sides) if side is mine and other != place]
            for place, mine in enumerate(roster.sides)
        ]

    def say(self, tick: int, speaker: str, word: Radio) -> str | None:
        """Send a word to all teammates; returns why it was refused, or nothing."""
        place = self._roster.names.index(speaker)
        said = word.model_dump_json(exclude_defaults=True).encode()
        bits = 8 * len(said)
        team = self._teams[self._roster.sides[place]]
        self._forget(team, tick)
        if team.bits + bits > self._air.budget * _WINDOW_S:
            return f"radio: the team's budget of {self._air.budget / 1e6:g} Mbit/s is used up"
        team.said.append((tick, bits))
        team.bits += bits
        opened = said[:-1] + (b"," if len(said) > len(_EMPTY) else b"")
        self._travelling.append(_Word(tick, tick + self._delay, place, b'"%s":%s' % (speaker.encode(), opened)))
        return None

    def listen(self, tick: int) -> list[bytes]:
        """What everybody has heard by this tick, as JSON: teammate → `schemas.sight.Heard`, the newest of each."""
        while self._travelling and self._travelling[0].arrives <= tick:
            self._deliver(self._travelling.popleft())
        tick_s = self._tick_s
        return [
            b"{%s}"
            % b",".join([b'%s"age":%.4f}' % (word.opened, (tick - word.said) * tick_s) for word in heard.values()])
            for heard in self._heard
        ]

    def _deliver(self, word: _Word) -> None:
        luck = self._luck.at(word.said)[word.speaker]
        for mate in self._mates[word.speaker]:
            if luck[mate] >= self._air.loss:
                self._heard[mate][word.speaker] = word

    def _forget(self, team: _TeamAir, tick: int) -> None:
        oldest = tick - _WINDOW_S / self._tick_s
        while team.said and team.said[0][0] <= oldest:
            team.bits -= team.said.popleft()[1]
