"""What a recording says of the match before the first tick of a stretch that is simulated again."""

from collections.abc import Iterable
from typing import Any

from pydantic_core import from_json, to_json

from recordings.course import Stretch, TickNote
from recordings.head import PROFILE
from recordings.reader import Recording
from schemas.errors import TouchlineError
from schemas.match_config import MatchConfig
from schemas.message import BadMessageError
from schemas.obstacle import Shape, StaticObstacle
from schemas.profile import STANDARD
from schemas.roster import RosterEntry
from schemas.side import Side
from schemas.world import World
from sim_host.resimulation import ImpossibleTickError, InForce, Known, numbers_of
from sim_host.tuning import Tuning


def beginning(recording: Recording, stretch: Stretch, before: TickNote | None) -> tuple[InForce, Known | None]:
    """What is in force before the first tick of a stretch, and what is known of the world then.

    Raises:
        ImpossibleTickError: the tick before is not as any host would note it.
        TouchlineError: the recording does not say how the match was set up.
    """
    changes = stretch.start.changes
    from_start = stretch.ticks.start == 0 or any(one.tick == 0 for one in changes)
    in_force = InForce(_numbers(recording, from_start=from_start))
    known = None
    if stretch.ticks.start > 0:
        known = _known(before)
        if not from_start:
            robots, obstacles = tuple(_robots(recording)), tuple(_obstacles(known.world))
            in_force = InForce(in_force.tuning, robots, obstacles)
    for one in changes:
        in_force = in_force.after(one)
    return in_force, known


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


def _known(before: TickNote | None) -> Known:
    if before is None or before.applied is None or before.world is None:
        raise ImpossibleTickError("the world of the tick before, to begin with, was not recorded")
    try:
        return Known(World.decode(to_json(before.world)), before.applied.chain)
    except BadMessageError as error:
        raise ImpossibleTickError(str(error)) from None


def _numbers(recording: Recording, *, from_start: bool) -> Tuning:
    """What the match was played with: at its start, or when the recorder asked the host."""
    setup, config = recording.manifest.setup, config_of(recording)
    if config is not None:
        tuning = Tuning.of(config)
        return tuning if from_start or setup is None else tuning.laid_over(setup.parameters)
    if setup is None or (from_start and setup.parameters):
        raise TouchlineError(
            f"{recording.path}: nothing in it says what numbers the match began with; record it from its beginning, "
            "with touchline match --record"
        )
    return numbers_of(setup)


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
