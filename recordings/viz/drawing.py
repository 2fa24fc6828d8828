"""Draws a match: a pure core, (what the host says) → messages for viewers, written beside those that they come from."""

from collections.abc import Callable
from typing import Any, NamedTuple

from recordings.viz.field import field_entities, obstacle_entity
from recordings.viz.foxglove import FRAME_TRANSFORMS, LOG, SCENE_UPDATE
from recordings.viz.game import board, log_entry
from recordings.viz.look import Look, look_at
from recordings.viz.primitives import Values, body, scene
from recordings.viz.robots import Player, ball_entities, robot_entity
from recordings.viz.transforms import Transforms
from schemas.bus.contract import Received
from schemas.game import GameEvent, GameState
from schemas.host import Applied, Setup
from schemas.message import BadMessageError
from schemas.profile import STANDARD
from schemas.topics import APPLIED, EVENT, STATE, WORLD
from schemas.world import ObstacleTruth

TF, FIELD, ROBOTS, BALL, GAME, EVENTS = "/tf", "/viz/field", "/viz/robots", "/viz/ball", "/viz/game", "/viz/events"
SCHEMAS = {
    TF: FRAME_TRANSFORMS,
    FIELD: SCENE_UPDATE,
    ROBOTS: SCENE_UPDATE,
    BALL: SCENE_UPDATE,
    GAME: SCENE_UPDATE,
    EVENTS: LOG,
}
"""Topic → its message."""
TF_STEP_NS = 19_000_000
"""Least simulated time between two transforms: every tick of 20 ms or more, 50 Hz of shorter ones."""
REPEAT_NS = 5_000_000_000
"""Simulated time after which what stands still is drawn again, for those who begin to look in the middle."""
READS = frozenset({WORLD.key, STATE.key, EVENT.key, APPLIED.key})
"""Keys of the messages that it is made of."""
_ROSTER = b'"robots":['
_NO_MESSAGE = (BadMessageError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What comes of payloads that are no message: nothing is drawn of these."""


class Drawn(NamedTuple):
    """One message for viewers."""

    topic: str
    payload: bytes


class _Scene(NamedTuple):
    """What stands still, as it was drawn."""

    look: Any
    """What decides how it looks."""
    bodies: dict[str, bytes]
    """Entity → its bytes."""
    gone: list[str]
    """What was there before, and is not any more."""


class Drawing:
    """What viewers see of a match so far."""

    def __init__(self, setup: Setup) -> None:
        self._setup = setup
        self._transforms = Transforms()
        self._tf_ns: int | None = None
        self._drawn_ns: int | None = None
        self._scenes: dict[str, _Scene] = {}
        """Topic → what was drawn there last."""
        self._cast = {
            robot: Player(robot, side, team.types.get(robot, STANDARD), team.goalkeeper and robot == team.robots[0])
            for side, team in setup.teams.items()
            for robot in team.robots
        }
        self._takers: dict[str, Callable[[Received, int], list[Drawn]]] = {
            WORLD.key: self._world,
            STATE.key: self._state,
            EVENT.key: self._event,
            APPLIED.key: self._applied,
        }

    def take(self, received: Received, log_ns: int) -> list[Drawn]:
        """What a message brings for viewers, at its own log time in ns; of most there is nothing."""
        taker = self._takers.get(received.key)
        if taker is None:
            return []
        try:
            return taker(received, log_ns)
        except _NO_MESSAGE:
            return []

    def _world(self, received: Received, log_ns: int) -> list[Drawn]:
        world = look_at(received.payload)
        out = []
        if self._tf_ns is None or log_ns - self._tf_ns >= TF_STEP_NS:
            out.append(Drawn(TF, self._transforms.encode(world, log_ns)))
            self._tf_ns = log_ns
        again = self._drawn_ns is None or log_ns - self._drawn_ns >= REPEAT_NS
        if again:
            self._drawn_ns = log_ns
        return out + self._still(world, log_ns, again=again)

    def _still(self, world: Look, log_ns: int, *, again: bool) -> list[Drawn]:
        """What moves with its frame alone, where it looks otherwise than before, or is to be said again.

        A scene needs none before it: what was there once and is gone is taken away each time.
        """
        out = []
        for topic, (look_of, entities_of) in _STILL.items():
            look, still = look_of(world), self._scenes.get(topic)
            if still is None or still.look != look:
                bodies = {entity["id"]: body(entity) for entity in entities_of(self, look)}
                gone = (
                    [name for name in (*still.bodies, *still.gone) if name not in bodies] if still is not None else []
                )
                still = self._scenes[topic] = _Scene(look, bodies, gone)
            elif not again:
                continue
            out.append(Drawn(topic, scene(log_ns, still.bodies.values(), still.gone)))
        return out

    def _field(self, obstacles: dict[str, Any]) -> list[Values]:
        bodies = [obstacle_entity(name, ObstacleTruth.model_validate(one)) for name, one in obstacles.items()]
        return [*field_entities(self._setup.pitch), *bodies]

    def _robots(self, look: list[tuple[str, str | None]]) -> list[Values]:
        return [robot_entity(self._player(name)._replace(off_field=why), self._setup) for name, why in look]

    def _ball(self, possession: str | None) -> list[Values]:
        return ball_entities(self._setup, self._player(possession) if possession is not None else None)

    def _player(self, name: str) -> Player:
        return self._cast.get(name) or Player(name, None)

    def _state(self, received: Received, log_ns: int) -> list[Drawn]:
        state: GameState = received.message()
        return [Drawn(GAME, board(state, self._setup, log_ns))]

    def _event(self, received: Received, log_ns: int) -> list[Drawn]:
        event: GameEvent = received.message()
        return [Drawn(EVENTS, log_entry(event, log_ns))]

    def _applied(self, received: Received, log_ns: int) -> list[Drawn]:
        """Who takes part may have changed; the next world shows it."""
        del log_ns
        if _ROSTER in received.payload:
            applied: Applied = received.message()
            for one in applied.robots or ():
                self._cast[one.name] = Player(one.name, one.side, one.type, one.keeper)
            if ROBOTS in self._scenes:
                self._scenes[ROBOTS] = self._scenes[ROBOTS]._replace(look=None)
        return []


_STILL: dict[str, tuple[Callable[[Look], Any], Callable[[Drawing, Any], list[Values]]]] = {
    FIELD: (lambda world: world.obstacles, Drawing._field),
    ROBOTS: (
        lambda world: [(name, robot.off_field) for name, robot in world.robots.items()],
        Drawing._robots,
    ),
    BALL: (lambda world: world.possession, Drawing._ball),
}
"""Topic → what of a world decides how it looks, and what it then looks like."""
