"""Sights as they are sent: what each robot perceives, hears and is told at one tick, written once, as JSON.

Ten sights a tick are most of what a host says; they are filled into forms, which costs half of what a general encoder
takes, and what a picture shows is written once for all ticks until the next. What a sight is, `schemas.sight.Sight`
says, and every reader checks.
"""

from collections.abc import Callable, Mapping, Sequence

from pydantic_core import to_json

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.message import VERSION
from schemas.side import Side
from sim_host.radio import RadioAir
from sim_host.referee.state import RefereeState
from sim_host.referee.view import game_views
from sim_host.sensing.perception import Perception
from sim_host.snapshot import Roster, Snapshot

Send = Callable[[str, bytes], None]
"""Takes a robot's name and its sight."""

_JSON = {True: b"true", False: b"false"}
_NOTHING_REFUSED = b"[]"


def _numbers(*names: str) -> str:
    """A form for an object of perceived numbers, given to 0.1 mm: below any sensor's noise, and half the bytes."""
    return ",".join(f'"{name}":%.4f' for name in names)


_BALL = b'{%b,"age":%.4f,"visible":%b}'
_PLACE = _numbers("x", "y", "z", "vx", "vy").encode()
"""Where a picture shows the ball."""
_NOW = b'"tick":%d,"time":%b'
_TOLD = b'"game":%b,"order":%b'
"""What all robots of a side are told alike."""
_OBSTACLE = f"{{{_numbers('x', 'y', 'radius')}}}".encode()


def _form(robot: str, side: Side) -> bytes:
    """The form of one robot's sights: what it perceives first."""
    own = _numbers("x", "y", "heading", "vx", "vy", "omega")
    return (
        f'{{"version":"{VERSION}","robot":"{robot}","side":"{side.value}","self":{{{own}}},'
        '"ball":%b,"obstacles":[%b],"obstacles_age":%.4f,'
        '%b,"holding":%b,"kicker_ready":%b,"stuck":%b,%b,'
        '"outcome":{"answers_tick":%b,"refused":%b},"radio":%b}'
    ).encode()


class _Written:
    """The things of one kind that a picture shows one robot, written once."""

    def __init__(self, form: bytes) -> None:
        self._form = form
        self._each = form.count(b"%")
        self._numbers: list[float] | None = None
        self._text = b""

    def text(self, numbers: list[float]) -> bytes:
        """JSON of one after the other; the same list again is the same picture again."""
        if numbers is not self._numbers:
            self._numbers = numbers
            self._text = b",".join([self._form] * (len(numbers) // self._each)) % tuple(numbers)
        return self._text


class Sights:
    """Makes the sights of all robots of a match."""

    def __init__(self, roster: Roster, perception: Perception, radio: RadioAir) -> None:
        self._roster = roster
        self._perception = perception
        self._radio = radio
        self._forms = [_form(name, side) for name, side in zip(roster.names, roster.sides, strict=True)]
        self._balls = [_Written(_PLACE) for _ in roster.names]
        self._obstacles = [_Written(_OBSTACLE) for _ in roster.names]

    def at(
        self,
        snapshot: Snapshot,
        state: RefereeState,
        episode: int,
        stuck: Sequence[bool],
        orders: Mapping[Side, CoachOrder],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
        send: Send,
    ) -> dict[str, bytes]:
        """Robot → its `schemas.sight.Sight` as JSON; each is sent as soon as it is written."""
        percepts = self._perception.at(snapshot, state.cyan_attacks)
        heard = self._radio.listen(snapshot.tick)
        views = game_views(state, self._roster, episode)
        told = {side: _TOLD % (view, _order(orders.get(side))) for side, view in views.items()}
        now = _NOW % (snapshot.tick, repr(snapshot.time).encode())
        sights = {}
        for place, (name, side) in enumerate(zip(self._roster.names, self._roster.sides, strict=True)):
            command, refused = commands.get(name), refusals.get(name)
            own, ball, ball_age, visible, obstacles, obstacles_age = percepts[place]
            sight = self._forms[place] % (
                *own,
                b"null" if ball is None else _BALL % (self._balls[place].text(ball), ball_age, _JSON[visible]),
                self._obstacles[place].text(obstacles),
                obstacles_age,
                now,
                _JSON[name == snapshot.possession],
                _JSON[snapshot.kickers_ready[place]],
                _JSON[stuck[place]],
                told[side],
                b"null" if command is None else b"%d" % command.answers_tick,
                _NOTHING_REFUSED if refused is None else to_json(refused),
                heard[place],
            )
            send(name, sight)
            sights[name] = sight
        self._perception.develop()
        return sights


def _order(order: CoachOrder | None) -> bytes:
    return b"null" if order is None else to_json(order)
