"""The state of a recorded match before the first tick of a segment that is simulated again."""

from collections.abc import Iterable
from typing import Any

from recordings.container.lineup import Lineup
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording
from recordings.reading.tick_index import Segment
from recordings.reading.tick_records import TickRecord
from schemas.config.obstacle import ObstacleConfig, Shape
from schemas.config.roster import RosterEntry
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.world import World
from schemas.wire.message import BadMessageError
from schemas.wire.part import encode
from sim_host.game.judging import PlayState
from sim_host.games import game_of_match
from sim_host.match.game_resimulation import state_conflicts
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.opening import opening_state
from sim_host.match.resimulation import CheckpointState, Conditions, ImpossibleTickError, parameters_of
from touchline.verify.verdict import Detail


def resim_start(
    recording: Recording, segment: Segment, before: TickRecord | None
) -> tuple[Conditions, CheckpointState | None]:
    """The parameters and the world before the first tick of a segment, as far as they are recorded.

    Raises:
        ImpossibleTickError: no host can have recorded the tick before.
        TouchlineError: the recording lacks the setup of the match.
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


def tick_length(recording: Recording) -> float:
    """The control tick of the match in s.

    Raises:
        TouchlineError: the recording has neither setup nor match file.
    """
    setup, config = recording.manifest.setup, config_of(recording)
    if setup is not None:
        return setup.time.tick
    if config is None:
        raise TouchlineError(f"{recording.path}: the setup of the match is missing; record it with its host")
    return config.load_profile().time.tick


def opening_conflict(recording: Recording, state: PlayState) -> list[Detail]:
    """Where the state of the referee at tick 0 is not the one with which the match file begins."""
    config = config_of(recording)
    if config is None:
        return []
    expected = opening_state(config, game_of_match(config))
    return [Detail("referee", one.field, one.recorded, one.simulated) for one in state_conflicts(state, expected)]


def _known(before: TickRecord | None) -> CheckpointState:
    if before is None or before.applied is None or before.world is None:
        raise ImpossibleTickError("the world of the tick before the segment was not recorded")
    try:
        return CheckpointState(World.decode(encode(before.world)), before.applied.chain)
    except BadMessageError as error:
        raise ImpossibleTickError(str(error)) from None


def _parameters(recording: Recording, *, from_start: bool) -> LiveParameters:
    """The parameters of the match: at its start, or at the recorder's query to the host."""
    setup, config = recording.manifest.setup, config_of(recording)
    if config is not None:
        live_parameters = LiveParameters.of(config)
        return live_parameters if from_start or setup is None else live_parameters.with_settings(setup.parameters)
    if setup is None or (from_start and setup.parameters):
        raise TouchlineError(
            f"{recording.path}: the parameters at the start of the match are missing; record it from its start, "
            "with touchline match --record"
        )
    return parameters_of(setup)


def _robots(recording: Recording) -> Iterable[RosterEntry]:
    """The robots that took part at the recorder's query, in the order of the roster."""
    setup, config = recording.manifest.setup, config_of(recording)
    if setup is None and config is not None:
        setup = Setup.of(config, config.load_profile(), config.load_rule_book())
    return Lineup.of(setup).robots.values()


def _obstacles(world: World) -> Iterable[ObstacleConfig]:
    """The obstacles on the pitch, from the world message."""
    for name, one in world.obstacles.items():
        extents: dict[str, Any] = {"size": [one.size_x, one.size_y, one.height]}
        if one.shape is Shape.CYLINDER:
            extents = {"radius": one.radius, "height": one.height}
        if one.pushed is not None:
            extents |= {"mass": one.pushed.mass, "friction": one.pushed.friction}
        yield ObstacleConfig(name=name, shape=one.shape, place=[one.x, one.y], heading=one.heading, **extents)
