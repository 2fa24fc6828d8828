"""Sights as they are sent: what each robot perceives, hears and is told at one tick, written once, as JSON.

Ten sights a tick are most of what a host says; they are filled into one form, which costs half of what a general
encoder takes. What a sight is, `schemas.sight.Sight` says, and every reader checks.
"""

from collections.abc import Callable, Mapping, Sequence

from pydantic_core import to_json

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.message import VERSION
from schemas.side import Side
from sim_host.radio import RadioAir
from sim_host.referee.state import RefereeState
from sim_host.referee.view import game_view
from sim_host.sensing.perception import Perception
from sim_host.snapshot import Roster, Snapshot

Send = Callable[[str, bytes], None]
"""Takes a robot's name and its sight."""

_JSON = {True: b"true", False: b"false"}
_NOTHING_REFUSED = b"[]"


def _numbers(*names: str) -> str:
    """A form for an object of perceived numbers, given to 0.1 mm: below any sensor's noise, and half the bytes."""
    return ",".join(f'"{name}":%.4f' for name in names)


def _form(robot: str, side: Side, others: int, radius: float) -> bytes:
    """The form of one robot's sights: perceived numbers first, then what differs from tick to tick."""
    own, ball = _numbers("x", "y", "heading", "vx", "vy", "omega"), _numbers("x", "y", "z", "vx", "vy")
    obstacles = ",".join([f'{{{_numbers("x", "y")},"radius":{radius!r}}}'] * others)
    return (
        f'{{"version":"{VERSION}","robot":"{robot}","side":"{side.value}","self":{{{own}}},'
        f'"ball":{{{ball},"age":0.0,"visible":true}},"obstacles":[{obstacles}],'
        '"tick":%d,"time":%b,"holding":%b,"stuck":%b,"game":%b,"order":%b,'
        '"outcome":{"answers_tick":%b,"refused":%b},"radio":%b}'
    ).encode()


class Sights:
    """Makes the sights of all robots of a match."""

    def __init__(self, roster: Roster, robot_radius: float, perception: Perception, radio: RadioAir) -> None:
        self._roster = roster
        self._perception = perception
        self._radio = radio
        others = len(roster.names) - 1
        pairs = zip(roster.names, roster.sides, strict=True)
        self._forms = [_form(name, side, others, robot_radius) for name, side in pairs]

    def at(
        self,
        snapshot: Snapshot,
        state: RefereeState,
        stuck: Sequence[bool],
        orders: Mapping[Side, CoachOrder],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
        send: Send,
    ) -> dict[str, bytes]:
        """Robot → its `schemas.sight.Sight` as JSON; each is sent as soon as it is written."""
        percepts = self._perception.at(snapshot, state.cyan_attacks)
        heard = self._radio.listen(snapshot.tick)
        games = {side: to_json(game_view(state, side)) for side in Side}
        told = {side: to_json(orders.get(side)) for side in Side}
        time = repr(snapshot.time).encode()
        sights = {}
        for place, (name, side) in enumerate(zip(self._roster.names, self._roster.sides, strict=True)):
            command, refused = commands.get(name), refusals.get(name)
            sight = self._forms[place] % (
                *percepts[place],
                snapshot.tick,
                time,
                _JSON[name == snapshot.possession],
                _JSON[stuck[place]],
                games[side],
                told[side],
                b"null" if command is None else b"%d" % command.answers_tick,
                _NOTHING_REFUSED if refused is None else to_json(refused),
                heard[place],
            )
            send(name, sight)
            sights[name] = sight
        return sights
