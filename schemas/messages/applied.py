"""The applied inputs of each tick, and the part of them that the hash chain covers."""

from collections.abc import Mapping
from typing import Any

import msgspec

from schemas.config.obstacle import ObstacleConfig
from schemas.config.roster import Placement, RosterEntry
from schemas.messages.command import Drive, Kick
from schemas.messages.parameters import ParameterName, Setting
from schemas.messages.soccer.game import GameEvent, RefereeAction
from schemas.soccer.game import EventKind
from schemas.wire.message import BadMessageError, Message, Name
from schemas.wire.part import Part, encode

_UNCHAINED = ("chain", "changes")
"""Fields that the chain does not cover: itself, and sentences that depend on the name of an operator."""
_decode_fields = msgspec.json.Decoder(dict[str, Any]).decode


class AppliedInput(Part, kw_only=False):
    """The input of one robot's actuators in one tick, after validation and watchdog."""

    drive: Drive
    """Velocity demand in the body frame."""
    dribble: bool
    """The dribbler is on."""
    kick: Kick | None = None
    """The kick of this tick; None without one."""
    answers_tick: int | None = None
    """Tick of the sight that this input answers; None while the robot is silent."""


class OperatorChange(Part, kw_only=False):
    """A change that an operator made before a tick."""

    kind: EventKind
    """`scene` or `parameters`."""
    rule: str
    """Name of the operation."""
    text: str
    """The change as one sentence; the text of its event."""

    def event(self, tick: int, time: float, clock: float) -> GameEvent:
        """The event that reports the change."""
        return GameEvent(tick=tick, time=time, clock=clock, kind=self.kind, rule=self.rule, text=self.text)


class Applied(Message):
    """All inputs that led to this tick, and the hash chain over the states of all ticks so far.

    With the manifest, this suffices to simulate the match again and to compare each tick.
    """

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    inputs: dict[Name, AppliedInput]
    """Robot → the input of its actuators."""
    placements: list[Placement] = []
    """Bodies that an operator or the referee placed before this tick."""
    checkpoint: bool = False
    """The world was rebuilt from poses and velocities before this tick: re-simulation may begin here."""
    remade: bool = False
    """The world was rebuilt with the parameters, robots and obstacles in force, before bodies were placed."""
    parameters: dict[ParameterName, Setting] = {}
    """Live parameters that were changed before this tick → new value."""
    robots: list[RosterEntry] | None = None
    """The robots that take part from this tick on, in the order of the roster; given at tick 0 and on a change,
    otherwise None."""
    obstacles: list[ObstacleConfig] | None = None
    """The obstacles on the pitch from this tick on; None where they have not changed."""
    episode: int = 1
    """The episode that this tick belongs to: the start of the match is 1, and each scene that is loaded and each reset
    begin another."""
    actions: list[RefereeAction] = []
    """Actions of people, coaches and the referee box that the referee judged in this tick, with those it refused."""
    silent: list[Name] = []
    """Robots that the referee knew to be without a responding agent in this tick."""
    referee: str = ""
    """At a checkpoint, the complete state of the referee before it judged this tick, as JSON; otherwise empty."""
    refbox: bool = False
    """A league's referee box was connected in this tick."""
    changes: list[OperatorChange] = []
    """The operators' changes before this tick, in their order; the chain does not cover these sentences."""
    chain: str
    """blake2b over the state of this tick and all other fields of this message but `changes`, keyed with the chain
    before it; hex."""


def chained_part(applied: Mapping[str, Any]) -> bytes:
    """The bytes of an `Applied` that the hash chain covers: all fields but `chain` and `changes`, in their order.

    They are JSON without spaces, with the shortest form of each float, without the closing brace. The same fields give
    the same bytes, however the host that published them formats its JSON.
    """
    return encode({name: value for name, value in applied.items() if name not in _UNCHAINED})[:-1]


def chained_part_of(payload: bytes) -> bytes:
    """The bytes that the hash chain covers of an `Applied` as it was published.

    Raises:
        BadMessageError: the payload is not a JSON object.
    """
    try:
        return chained_part(_decode_fields(payload))
    except ValueError as error:
        raise BadMessageError(f"Applied: cannot be read: {error}") from None
