"""Draws a match for viewers: turns messages of the host into messages of `foxglove.*`, without side effects."""

import itertools
from collections.abc import Callable
from typing import Any, NamedTuple

from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate

from recordings.container.applied_changes import changes_in
from recordings.container.lineup import Lineup
from recordings.viz.debug import debug_entity
from recordings.viz.drawn_world import DrawnWorld, decode_world
from recordings.viz.field import field_entities, floor_entities, obstacle_entity, zone_entity
from recordings.viz.foxglove import FRAME_TRANSFORMS, LASER_SCAN, LOG, SCENE_UPDATE
from recordings.viz.primitives import encode_scene, scene_update
from recordings.viz.robots import RobotAppearance, ball_entities, robot_entity
from recordings.viz.scans import scans
from recordings.viz.soccer import log_entry, scoreboard
from recordings.viz.transforms import Transforms
from runtime.bus.contract import ReceivedMessage
from schemas.config.profile import STANDARD
from schemas.config.sensors.table import Sensor
from schemas.frames import MAP, pushed
from schemas.messages.applied import Applied
from schemas.messages.debug import RobotDebug
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import ObstacleTruth
from schemas.topics import APPLIED, DEBUG, EVENT, STATE, WORLD
from schemas.wire.message import BadMessageError
from schemas.wire.part_faults import validated

TF, FIELD, ROBOTS, BALL, GAME, EVENTS = "/tf", "/viz/field", "/viz/robots", "/viz/ball", "/viz/game", "/viz/events"
DRAWINGS = "/viz/debug"
SCHEMAS = {
    TF: FRAME_TRANSFORMS,
    FIELD: SCENE_UPDATE,
    ROBOTS: SCENE_UPDATE,
    BALL: SCENE_UPDATE,
    GAME: SCENE_UPDATE,
    EVENTS: LOG,
    DRAWINGS: SCENE_UPDATE,
}
"""Topic → name of its message; the topics of `scans` are those of the sensors of a match."""
TF_STEP_NS = 19_000_000
"""Least simulated time between two transforms, in ns: each tick of 20 ms or more, 50 Hz with shorter ticks."""
REPEAT_NS = 5_000_000_000
"""Simulated time, in ns, after which unchanged scenes are repeated, for viewers that start in the middle."""
READS = frozenset({WORLD.key, STATE.key, EVENT.key, APPLIED.key, DEBUG.key})
"""Rows of the topic table with the messages that a drawing is derived from."""
_INVALID_PAYLOAD = (BadMessageError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""Exceptions that invalid payloads cause; they are not drawn."""


def schema_of(topic: str) -> str:
    """The name of the message of a topic."""
    return SCHEMAS.get(topic, LASER_SCAN)


class VizMessage(NamedTuple):
    """One message for viewers."""

    topic: str
    payload: bytes


class _Layer(NamedTuple):
    """A scene as it was last drawn."""

    appearance: Any
    """The values that determine how the scene looks."""
    update: SceneUpdate


class Drawing:
    """Follows a match and draws its changes."""

    def __init__(self, setup: Setup) -> None:
        self._setup = setup
        self._transforms = Transforms()
        self._tf_ns: int | None = None
        self._drawn_ns: int | None = None
        self._layers: dict[str, _Layer] = {}
        """Topic → the newest scene on it."""
        self._lineup = Lineup.of(setup)
        self._handlers: dict[str, Callable[[ReceivedMessage, int], list[VizMessage]]] = {
            WORLD.key: self._world,
            STATE.key: self._state,
            EVENT.key: self._event,
            APPLIED.key: self._applied,
            DEBUG.key: self._debug,
        }

    def draw(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        """The messages for viewers that follow from a message with this log time in ns; mostly none."""
        handler = self._handlers.get(received.topic.key)
        if handler is None:
            return []
        try:
            return handler(received, log_ns)
        except _INVALID_PAYLOAD:
            return []

    def _world(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        world = decode_world(received.payload)
        out = []
        if self._tf_ns is None or log_ns - self._tf_ns >= TF_STEP_NS:
            out.append(VizMessage(TF, self._transforms.encode(world, log_ns)))
            self._tf_ns = log_ns
        repeat = self._drawn_ns is None or log_ns - self._drawn_ns >= REPEAT_NS
        if repeat:
            self._drawn_ns = log_ns
        out += itertools.starmap(VizMessage, scans(world, log_ns, self._sensors_of))
        return out + self._static_layers(world, log_ns, repeat=repeat)

    def _sensors_of(self, name: str) -> dict[str, Sensor]:
        robot = self._lineup.robots.get(name)
        return self._setup.sensors.get(robot.type if robot is not None else STANDARD, {})

    def _static_layers(self, world: DrawnWorld, log_ns: int, *, repeat: bool) -> list[VizMessage]:
        """The scenes whose entities move only with their frames: those that have changed, or all of them on `repeat`.

        Each scene is complete: it deletes the entities of earlier scenes that no longer exist.
        """
        out = []
        for topic, (appearance_of, entities_of) in _STATIC_LAYERS.items():
            if topic == BALL and world.ball is None:
                continue
            appearance, layer = appearance_of(world), self._layers.get(topic)
            if layer is None or layer.appearance != appearance:
                entities = entities_of(self, appearance)
                deleted = _named(layer.update) - {entity.id for entity in entities} if layer is not None else set()
                layer = self._layers[topic] = _Layer(appearance, scene_update(entities, sorted(deleted)))
            elif not repeat:
                continue
            out.append(VizMessage(topic, encode_scene(layer.update, log_ns)))
        return out

    def _field(self, obstacles: dict[str, tuple[str, Any]]) -> list[SceneEntity]:
        entities = [
            obstacle_entity(name, validated(ObstacleTruth, one), frame) for name, (frame, one) in obstacles.items()
        ]
        if (task := self._setup.task) is not None:
            entities = [*map(zone_entity, task.zones), *entities]
        drawn = field_entities if self._setup.free is None else floor_entities
        return [*drawn(self._setup.pitch), *entities]

    def _robots(self, appearance: list[tuple[str, str | None]]) -> list[SceneEntity]:
        return [robot_entity(self._appearance(name, why), self._setup) for name, why in appearance]

    def _ball(self, possession: str | None) -> list[SceneEntity]:
        return ball_entities(self._setup, self._appearance(possession) if possession is not None else None)

    def _appearance(self, name: str, off_field: str | None = None) -> RobotAppearance:
        robot = self._lineup.robots.get(name)
        if robot is None:
            return RobotAppearance(name, None, off_field=off_field)
        return RobotAppearance(name, robot.side, robot.type, robot.keeper, off_field)

    def _state(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        state: GameState = received.message()
        return [VizMessage(GAME, scoreboard(state, self._setup, log_ns))]

    def _event(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        event: GameEvent = received.message()
        return [VizMessage(EVENTS, log_entry(event, log_ns))]

    def _debug(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        drawing: RobotDebug = received.message()
        return [VizMessage(DRAWINGS, encode_scene(scene_update([debug_entity(drawing)]), log_ns))]

    def _applied(self, received: ReceivedMessage, log_ns: int) -> list[VizMessage]:
        """Follow changes of the roster; the next world shows them."""
        del log_ns
        if changes_in(received.payload).robots is not None:
            applied: Applied = received.message()
            self._lineup = self._lineup.changed(applied.robots or [])
            if ROBOTS in self._layers:
                self._layers[ROBOTS] = self._layers[ROBOTS]._replace(appearance=None)
        return []


def _named(update: SceneUpdate) -> set[str]:
    """The entities that an update draws or deletes."""
    return {entity.id for entity in update.entities} | {deletion.id for deletion in update.deletions}


def _obstacles(world: DrawnWorld) -> dict[str, tuple[str, Any]]:
    """Obstacle → its frame, and what it is in that frame: one that can be pushed moves with a frame of its own."""
    at_rest = {"x": 0.0, "y": 0.0, "heading": 0.0, "pushed": None}
    return {
        name: (pushed(name), one | at_rest) if "pushed" in one else (MAP, one) for name, one in world.obstacles.items()
    }


_STATIC_LAYERS: dict[str, tuple[Callable[[DrawnWorld], Any], Callable[[Drawing, Any], list[SceneEntity]]]] = {
    FIELD: (_obstacles, Drawing._field),
    ROBOTS: (
        lambda world: [(name, robot.off_field) for name, robot in world.robots.items()],
        Drawing._robots,
    ),
    BALL: (lambda world: world.possession, Drawing._ball),
}
"""Topic → the values of a world that determine how its scene looks, and the entities drawn from them."""
