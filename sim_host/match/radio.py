"""The radio between teammates: messages arrive late or not at all, and a team's messages have a byte budget."""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from schemas.config.sections import RadioChannel
from schemas.messages.radio import Radio
from schemas.messages.sight import ReceivedRadio
from schemas.side import Side
from schemas.wire.struct import encode
from sim_host.sensing.digits import DIGITS
from sim_host.sensing.random_streams import BatchedDraws, RandomStreams, StreamId
from sim_host.snapshot import Roster

_WINDOW_S = 1.0
"""The budget counts the messages that a team sent in this time."""

Delays = NDArray[np.int64]
"""Ticks from each member of a team to each, shape (members, members)."""
_LOST = -1
"""In place of a delay in ticks: the message never arrives."""
_ROUNDING = 1e-6
"""Ticks; a delay that exceeds a whole number of ticks by no more than this is that number: floats round."""


@dataclass(slots=True, eq=False)
class _RadioMessage:
    sent_at: int
    """Tick."""
    received: ReceivedRadio
    """As every receiver reads it at the tick `at`: its age counts."""
    at: int
    """Tick."""


@dataclass(slots=True)
class _TeamAir:
    sent: deque[tuple[int, int]] = field(default_factory=deque)
    """(tick, bits) of each message of the last second."""
    bits: int = 0


class RadioAir:
    """The radio of both teams.

    A message takes `delay` and a uniform share of `jitter`, drawn for each receiver, and arrives at the first tick
    after that. Messages can overtake each other; a receiver keeps the one that was sent last.
    """

    def __init__(self, air: RadioChannel, roster: Roster, tick: float, streams: RandomStreams) -> None:
        self._air = air
        self._roster = roster
        self._tick_s = tick
        self._streams = streams
        self._teams = {side: _TeamAir() for side in Side}
        self._under_way: dict[int, list[tuple[int, int, _RadioMessage]]] = {}
        """Tick of arrival → sender, receiver and message, in the order in which they were sent."""
        self._received: list[dict[int, _RadioMessage]] = [{} for _ in roster.names]
        """Per receiver, in the order of the roster: sender → its newest message."""
        self._members = {side: [index for index, its in enumerate(roster.sides) if its is side] for side in Side}
        self._delays = self._new_delays()

    def change(self, air: RadioChannel) -> None:
        """Use other delays, losses and budget from now on; messages under way arrive as planned."""
        self._air = air
        self._delays = self._new_delays()

    def with_roster(self, roster: Roster) -> "RadioAir":
        """The radio for another roster: robots that remain on their side keep all messages between them."""
        successor, before = RadioAir(self._air, roster, self._tick_s, self._streams), self._roster
        index = {
            old: roster.names.index(name)
            for old, name in enumerate(before.names)
            if name in roster.names and roster.side_of(name) is before.side_of(name)
        }
        successor._teams = self._teams
        successor._under_way = {
            arrives: [
                (index[sender], index[mate], message)
                for sender, mate, message in messages
                if sender in index and mate in index
            ]
            for arrives, messages in self._under_way.items()
        }
        for old, new in index.items():
            successor._received[new] = {
                index[sender]: message for sender, message in self._received[old].items() if sender in index
            }
        return successor

    def send(self, tick: int, sender: str, content: Radio) -> str | None:
        """Send a message to all teammates; returns why it was refused, or None.

        A field that is None or empty is not sent, and does not count toward the budget.
        """
        index = self._roster.names.index(sender)
        bits = 8 * len(encode(content))
        team = self._teams[self._roster.sides[index]]
        self._drop_old(team, tick)
        if team.bits + bits > self._air.budget * _WINDOW_S:
            return f"radio: the team's budget of {self._air.budget / 1e6:g} Mbit/s is used up"
        team.sent.append((tick, bits))
        team.bits += bits
        self._deliver(index, _RadioMessage(tick, ReceivedRadio.of(content), tick))
        return None

    def _deliver(self, sender: int, message: _RadioMessage) -> None:
        """Schedule a message for every teammate that will receive it."""
        side = self._roster.sides[sender]
        members = self._members[side]
        delays = self._delays[side].at(message.sent_at)[members.index(sender)].tolist()
        for mate, delay in zip(members, delays, strict=True):
            if mate != sender and delay != _LOST:
                self._under_way.setdefault(message.sent_at + delay, []).append((sender, mate, message))

    def _new_delays(self) -> dict[Side, BatchedDraws[Delays]]:
        """Per side and tick: the delay in ticks of a message from each member to each member."""
        names = self._roster.names
        return {
            side: BatchedDraws(partial(self._draw, [names[index] for index in members]))
            for side, members in self._members.items()
        }

    def _draw(self, names: Sequence[str], ticks: range) -> list[Delays]:
        air = self._air
        lost, late, *_ = np.moveaxis(self._streams.pairwise_uniforms(StreamId.AIR, names, names, ticks), -1, 0)
        whole = np.ceil((air.delay + late * air.jitter) / self._tick_s - _ROUNDING).astype(np.int64)
        return list(np.where(lost < air.loss, _LOST, whole))

    def receive(self, tick: int) -> list[dict[str, ReceivedRadio]]:
        """Per robot, in the order of the roster: teammate → its newest message that has arrived by this tick."""
        for arrives in sorted([one for one in self._under_way if one <= tick]):
            for sender, mate, message in self._under_way.pop(arrives):
                before = self._received[mate].get(sender)
                if before is None or message.sent_at > before.sent_at:
                    self._received[mate][sender] = message
        for newest in self._received:
            for message in newest.values():
                if message.at != tick:
                    age = round((tick - message.sent_at) * self._tick_s, DIGITS)
                    message.received, message.at = replace(message.received, age=age), tick
        names = self._roster.names
        return [{names[sender]: message.received for sender, message in newest.items()} for newest in self._received]

    def _drop_old(self, team: _TeamAir, tick: int) -> None:
        oldest = tick - _WINDOW_S / self._tick_s
        while team.sent and team.sent[0][0] <= oldest:
            team.bits -= team.sent.popleft()[1]
