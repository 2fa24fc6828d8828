"""Sights as they are sent: what each robot perceives, hears and is told at one tick, written once, as JSON.

Ten sights a tick are most of what a host says; they are filled into forms, which costs half of what a general encoder
takes, and what a picture shows is written once for all ticks until the next. What a sight is,
`schemas.messages.sight.Sight` says, and every reader checks.
"""

from collections.abc import Callable, Mapping, Sequence

from pydantic_core import to_json

from schemas.message import VERSION
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.side import Side
from sim_host.match.radio import RadioAir
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game_views import game_views
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
_TIME = b'"tick":%d,"time":%b'
_SHARED = b'"game":%b,"order":%b'
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


class _JsonCache:
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
        self._balls = [_JsonCache(_PLACE) for _ in roster.names]
        self._obstacles = [_JsonCache(_OBSTACLE) for _ in roster.names]

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
        """Robot → its `schemas.messages.sight.Sight` as JSON; each is sent as soon as it is written."""
        percepts = self._perception.at(snapshot, state.cyan_attacks)
        heard = self._radio.receive(snapshot.tick)
        views = game_views(state, self._roster, episode)
        shared = {side: _SHARED % (view, _order(orders.get(side))) for side, view in views.items()}
        now = _TIME % (snapshot.tick, repr(snapshot.time).encode())
        sights = {}
        for index, (name, side) in enumerate(zip(self._roster.names, self._roster.sides, strict=True)):
            command, refused = commands.get(name), refusals.get(name)
            own, ball, ball_age, visible, obstacles, obstacles_age = percepts[index]
            sight = self._forms[index] % (
                *own,
                b"null" if ball is None else _BALL % (self._balls[index].text(ball), ball_age, _JSON[visible]),
                self._obstacles[index].text(obstacles),
                obstacles_age,
                now,
                _JSON[name == snapshot.possession],
                _JSON[snapshot.kickers_ready[index]],
                _JSON[stuck[index]],
                shared[side],
                b"null" if command is None else b"%d" % command.answers_tick,
                _NOTHING_REFUSED if refused is None else to_json(refused),
                heard[index],
            )
            send(name, sight)
            sights[name] = sight
        self._perception.develop()
        return sights


def _order(order: CoachOrder | None) -> bytes:
    return b"null" if order is None else to_json(order)
