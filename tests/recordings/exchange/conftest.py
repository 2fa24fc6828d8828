"""A real match of two a side, both halves of it, played in this process and recorded."""

from collections.abc import Iterator

import pytest

from recordings.container.manifest import Manifest
from recordings.editing.compose import TimedMessage, compose
from recordings.reading.recording import Recording, open_recording
from schemas.config.match_config import load_match
from schemas.messages.applied import Applied
from schemas.messages.command import Command
from schemas.messages.world import World
from schemas.topics import APPLIED, COMMAND, EVENT, STATE, WORLD
from schemas.wire.message import VERSION
from schemas.wire.part_faults import validated
from touchline.play.play_match import InProcessMatch

STARTED = "2026-07-01T15:00:00.000+00:00"


def played(table: InProcessMatch) -> Iterator[TimedMessage]:
    """All messages of the match, tick by tick."""
    simulation = table.simulation
    said = None
    tick = simulation.now
    while True:
        now = round(tick.time * 1e9)
        yield TimedMessage(now, WORLD, WORLD.key, validated(World, tick.world))
        yield TimedMessage(now, APPLIED, APPLIED.key, Applied.decode(tick.applied_encoded))
        state = simulation.state.game_state(tick.tick, tick.time, 1)
        news = (state.phase, state.side, state.running, state.half, state.score)
        if news != said or tick.tick % 50 == 0:
            yield TimedMessage(now, STATE, STATE.key, state)
            said = news
        yield from (TimedMessage(now, EVENT, EVENT.key, event) for event in tick.events)
        for name, given in tick.applied["inputs"].items():
            key = COMMAND.fill(robot=name)
            yield TimedMessage(now, COMMAND, key, Command(answers_tick=tick.tick, drive=given.drive, kick=given.kick))
        if simulation.over:
            break
        tick = table.step()
    simulation.close()


@pytest.fixture(scope="session")
def real(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    teams = {f"teams.{side}.size": 2 for side in ("cyan", "magenta")}
    config = load_match(None, {"name": "short", "seed": 7, "duration": 8.0, **teams})
    table = InProcessMatch(config)
    manifest = Manifest(
        contract=VERSION,
        match="short",
        recorder="test",
        started=STARTED,
        sights=False,
        versions={},
        libm="",
        setup=table.simulation.setup(),
        config=config,
    )
    path = tmp_path_factory.mktemp("real") / "short.mcap"
    compose(path, manifest, {}, played(table))
    return open_recording(path)
