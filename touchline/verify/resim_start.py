"""What a recording says of the match before the first tick of a segment that is simulated again."""

from collections.abc import Iterable
from typing import Any

from pydantic_core import from_json, to_json

from recordings.container.attachments import PROFILE
from recordings.reading.recording import Recording
from recordings.reading.tick_index import Segment
from recordings.reading.tick_records import TickRecord
from schemas.config.match_config import MatchConfig
from schemas.config.obstacle import Shape, StaticObstacle
from schemas.config.profile import STANDARD
from schemas.config.roster import RosterEntry
from schemas.errors import TouchlineError
from schemas.messages.world import World
from schemas.side import Side
from schemas.wire.message import BadMessageError
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.resimulation import CheckpointState, Conditions, ImpossibleTickError, parameters_of


def resim_start(
    recording: Recording, segment: Segment, before: TickRecord | None
) -> tuple[Conditions, CheckpointState | None]:
    """What is in force before the first tick of a segment, and what is known of the world then.

    Raises:
        ImpossibleTickError: the tick before is not as any host would note it.
        TouchlineError: the recording does not say how the match was set up.
    """
    changes = segment.start.changes
    from_start = segment.ticks.start == 0 or any(one.tick == 0 for one in changes)
    conditions = Conditions(_parameters(recording, from_start=from_start))
    known = None
    if segment.ticks.start > 0:
        known = _known(before)
        if not from_start:
            robots, obstacles = tuple(_robots(recording)), tuple(_obstacles(known.world))
            conditions = Conditions(conditions.live_parameters, robots, obstacles)
    for one in changes:
        conditions = conditions.after(one)
    return conditions, known


def config_of(recording: Recording) -> MatchConfig | None:
    """The config of a recording with the profile that is attached to it; None where it was not recorded.

    Raises:
        TouchlineError: the attached profile is damaged.
    """
    config, tables = recording.manifest.config, recording.attachments.get(PROFILE)
    if config is None or tables is None:
        return config
    try:
        return config.model_copy(update={"profile_tables": from_json(tables)})
    except ValueError:
        raise TouchlineError(f"{recording.path}: {PROFILE}, attached to it, is damaged; take another copy") from None


def need_scene(recording: Recording) -> None:
    """Make sure that the config of a recording has the scene that the match started in.

    Raises:
        TouchlineError: the config only names it, and it cannot be read.
    """
    missing = recording.manifest.missing_scene
    if missing is not None:
        raise TouchlineError(f"{recording.path}: its scene {missing} cannot be read; restore that file")


def _known(before: TickRecord | None) -> CheckpointState:
    if before is None or before.applied is None or before.world is None:
        raise ImpossibleTickError("the world of the tick before, to begin with, was not recorded")
    try:
        return CheckpointState(World.decode(to_json(before.world)), before.applied.chain)
    except BadMessageError as error:
        raise ImpossibleTickError(str(error)) from None


def _parameters(recording: Recording, *, from_start: bool) -> LiveParameters:
    """What the match was played with: at its start, or when the recorder asked the host."""
    setup, config = recording.manifest.setup, config_of(recording)
    if config is not None:
        live_parameters = LiveParameters.of(config)
        return live_parameters if from_start or setup is None else live_parameters.with_settings(setup.parameters)
    if setup is None or (from_start and setup.parameters):
        raise TouchlineError(
            f"{recording.path}: nothing in it says what numbers the match began with; record it from its beginning, "
            "with touchline match --record"
        )
    return parameters_of(setup)


def _robots(recording: Recording) -> Iterable[RosterEntry]:
    """The robots that took part when the recorder asked, in the order of the roster.

    Raises:
        TouchlineError: they are those of a scene that cannot be read.
    """
    manifest = recording.manifest
    for side in Side:
        if manifest.setup is not None:
            names, types = manifest.setup.teams[side].robots, manifest.setup.teams[side].types
        elif manifest.config is not None:
            need_scene(recording)
            names, types = manifest.config.robots(side), manifest.config.team(side).types
        else:
            return
        yield from (RosterEntry(name=name, side=side, type=types.get(name, STANDARD)) for name in names)


def _obstacles(world: World) -> Iterable[StaticObstacle]:
    """What stood on the pitch, as the world tells it."""
    for name, one in world.obstacles.items():
        extents: dict[str, Any] = {"size": [one.size_x, one.size_y, one.height]}
        if one.shape is Shape.CYLINDER:
            extents = {"radius": one.radius, "height": one.height}
        yield StaticObstacle(name=name, shape=one.shape, place=[one.x, one.y], heading=one.heading, **extents)
