"""Robots that people drive: what a hand says stands in for the command of the robot's brain."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from schemas.bus.contract import Bus
from schemas.command import Command, Kick
from schemas.hand import HandDrive
from schemas.message import BadMessageError
from schemas.topics import HAND
from sim_host.complaints import Complaints

HELD_S = 0.5
"""Wall time without a word after which a robot is given back."""


@dataclass(slots=True)
class _Hand:
    said: HandDrive
    heard_at: float
    """Wall time."""
    kick: Kick | None
    """Asked for and not handed on yet."""


class Hands:
    """Everybody who drives a robot by hand."""

    def __init__(self, bus: Bus, complaints: Complaints) -> None:
        self._said = bus.subscribe(HAND)
        self._clock = bus.clock
        self._complaints = complaints
        self._hands: dict[str, _Hand] = {}
        self._told: dict[str, bool] = {}

    def lay_over(self, tick: int, names: tuple[str, ...], commands: Mapping[str, Command]) -> dict[str, Command]:
        """The commands that answer `tick`, those of driven robots in place of their brains'.

        What the brain of a driven robot says on the radio is still said.
        """
        self._listen(names)
        laid = dict(commands)
        for name in [name for name in names if name in self._hands]:
            hand, own = self._hands[name], commands.get(name)
            laid[name] = Command(
                answers_tick=tick,
                drive=hand.said.drive,
                dribble=hand.said.dribble,
                kick=hand.kick,
                radio=own.radio if own is not None else None,
            )
            hand.kick = None
        return laid

    def changes(self) -> Iterator[tuple[str, bool]]:
        """Robots that were taken in hand or given back since this was last asked."""
        for name in sorted({*self._hands, *self._told}):
            driven = name in self._hands
            if driven != (name in self._told):
                yield name, driven
        self._told = dict.fromkeys(self._hands, True)

    def _listen(self, names: tuple[str, ...]) -> None:
        """Take in what has come, and let those go that are silent or not there."""
        now = self._clock.now()
        while (received := self._said.receive()) is not None:
            name = received.chunks["robot"]
            try:
                said: HandDrive = received.message()
                if name not in names:
                    raise BadMessageError("no robot of this match has that name")
            except BadMessageError as error:
                self._complaints.note(received.key, str(error), received.payload)
                continue
            if said.release:
                self._hands.pop(name, None)
                continue
            waiting = self._hands[name].kick if name in self._hands else None
            self._hands[name] = _Hand(said, now, said.kick or waiting)
        self._hands = {
            name: hand for name, hand in self._hands.items() if name in names and now - hand.heard_at < HELD_S
        }
