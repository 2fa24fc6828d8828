"""The radio between teammates: messages arrive late or not at all, and a team's messages have a byte budget."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from msgspec.structs import replace

from schemas.config.sections import RadioChannel
from schemas.messages.percept import DIGITS
from schemas.messages.radio import Radio
from schemas.messages.sight import ReceivedRadio
from schemas.side import Side
from schemas.wire.part import encode
from sim_host.match.radio_medium import Budget, SharedChannel
from sim_host.match.radio_timing import NEVER, RadioTiming, arrival_ticks
from sim_host.match.radio_use import RadioUse
from sim_host.sensing.random_streams import RandomStreams
from sim_host.snapshot import Roster

Shared = Callable[[Any], Any]
"""Makes of a part of several sights what all of them have."""


def as_it_is(part: Any) -> Any:
    """The part itself."""
    return part


@dataclass(slots=True, eq=False)
class _RadioMessage:
    left: float
    """Time of sending in ticks."""
    content: ReceivedRadio
    received: Any = None
    """As every receiver has it at the tick `at`: with its age."""
    at: int = -1
    """Tick."""

    def read_at(self, tick: int, tick_s: float, shared: Shared) -> Any:
        """The message with its age at this tick."""
        self.received = shared(replace(self.content, age=round((tick - self.left) * tick_s, DIGITS)))
        self.at = tick
        return self.received


class RadioAir:
    """The radio of both teams: each team has a budget, and its own channel unless the model is `shared`.

    A message leaves its robot at a time within the tick in which its command acts. It takes `delay` and a uniform share
    of `jitter`, drawn for each receiver, and is in the first sight at or after its arrival. Messages can overtake each
    other; a receiver keeps the one that was sent last.
    """

    def __init__(
        self, air: RadioChannel, roster: Roster, tick: float, streams: RandomStreams, use: RadioUse | None = None
    ) -> None:
        """`use` counts what is sent; by default a count of its own."""
        self.use = use if use is not None else RadioUse()
        self._air = air
        self._roster = roster
        self._tick_s = tick
        self._streams = streams
        self._timing = RadioTiming(air, roster, tick, streams)
        self._budgets = {side: Budget() for side in Side}
        self.use.follow(self._budgets)
        self._shared = SharedChannel()
        self._index = {name: index for index, name in enumerate(roster.names)}
        names = [(name, index, roster.sides[index]) for name, index in self._index.items()]
        self._mates = [
            [(name, index) for name, index, its in names if its is side and index != own]
            for own, side in enumerate(roster.sides)
        ]
        """Per robot: name and index of each teammate."""
        self._under_way: dict[int, list[tuple[int, int, _RadioMessage]]] = {}
        """Tick of arrival → receivers, senders and messages."""
        self._held: list[list[_RadioMessage | None]] = [[None] * len(names) for _ in names]
        """Per receiver and sender: the newest message that has arrived."""

    def change(self, air: RadioChannel) -> None:
        """Use other delays, losses and limits from now on; messages under way arrive as planned."""
        self._air = air
        self._timing = RadioTiming(air, self._roster, self._tick_s, self._streams)

    def with_roster(self, roster: Roster) -> "RadioAir":
        """The radio for another roster: robots that remain on their side keep all messages between them."""
        successor = RadioAir(self._air, roster, self._tick_s, self._streams, self.use)
        before = self._roster
        kept = {
            old: roster.names.index(name)
            for old, name in enumerate(before.names)
            if name in roster.names and roster.side_of(name) is before.side_of(name)
        }
        successor._budgets, successor._shared = self._budgets, self._shared
        self.use.follow(self._budgets)
        for old, new in kept.items():
            for sender, place in kept.items():
                successor._held[new][place] = self._held[old][sender]
        for tick, arriving in self._under_way.items():
            successor._under_way[tick] = [
                (kept[receiver], kept[sender], message)
                for receiver, sender, message in arriving
                if receiver in kept and sender in kept
            ]
        return successor

    def send(self, tick: int, contents: Mapping[str, Radio]) -> dict[str, str]:
        """Send messages to all teammates of their senders; returns sender → why its message was refused.

        The messages answer the sights of the tick before; the sights of `tick` are the first to have them. A field
        that is None or empty is not sent, and does not count toward the budget.
        """
        if not contents:
            return {}
        drawn = self._timing.at(tick)
        outgoing = sorted([(tick - 1 + drawn.leaves[self._index[name]], self._index[name]) for name in contents])
        refusals = {}
        for left, index in outgoing:
            name = self._roster.names[index]
            content = contents[name]
            side, bits = self._roster.sides[index], 8 * len(encode(content))
            end, refusal = self._transmit(left, bits, side)
            if refusal is not None:
                refusals[name] = refusal
                self.use.refused[name] += 1
                continue
            self.use.bits[name] += bits
            message = _RadioMessage(left, ReceivedRadio.of(content))
            is_shared = self._air.model == "shared"
            arrives = arrival_ticks(end + drawn.flights[:, index]) if is_shared else drawn.arrives[:, index]
            for receiver, arrival in enumerate(arrives.tolist()):
                if arrival != NEVER:
                    self._under_way.setdefault(arrival, []).append((receiver, index, message))
        return refusals

    def _transmit(self, left: float, bits: int, side: Side) -> tuple[float, str | None]:
        """When a message that leaves at `left` is on its way, both in ticks; or why it is refused."""
        air, budget, at = self._air, self._budgets[side], left * self._tick_s
        refusal = budget.refusal(at, bits, air.budget)
        end = left
        if refusal is None and air.model == "shared":
            end_s, refusal = self._shared.transmit(at, bits, air)
            end = end_s / self._tick_s
        if refusal is None:
            budget.spend(at, bits)
        return end, refusal

    def receive(self, tick: int, shared: Shared = as_it_is) -> Iterator[dict[str, Any]]:
        """Per robot, in the order of the roster: teammate → its newest message that has arrived by this tick.

        `shared` makes of each message what all receivers get, once a tick. What has arrived is noted at once; the
        mappings are made when they are read, also in a later tick.
        """
        for arrival in [arrival for arrival in self._under_way if arrival <= tick]:
            for receiver, sender, arrived in self._under_way.pop(arrival):
                known = self._held[receiver][sender]
                if known is None or known.left < arrived.left:  # a newer one may have come earlier
                    self._held[receiver][sender] = arrived
        held, tick_s = [row.copy() for row in self._held], self._tick_s
        return (
            {
                name: message.received if message.at == tick else message.read_at(tick, tick_s, shared)
                for name, sender in mates
                if (message := of_robot[sender]) is not None
            }
            for mates, of_robot in zip(self._mates, held, strict=True)
        )
