"""Real matches that are played in this process, without a network, and recorded."""

from collections.abc import Callable, Container, Sequence
from pathlib import Path

import pytest

from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from runtime.bus.batch_publisher import BatchPublisher
from schemas.config.match_config import MatchConfig, load_match
from schemas.config.settings import RecordOptions
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import RefereeAction
from schemas.topics import COMMAND, SETUP
from sim_host.match.simulation import Simulation
from sim_host.server.reports.debug_publisher import DebugPublisher
from sim_host.server.reports.outbox import Outbox
from support.in_process_bus import SharedState
from support.recorder_rig import ONE_PART
from support.stepped_clock import SteppedClock
from touchline.play.play_match import InProcessMatch


def record_match(
    path: Path,
    config: MatchConfig,
    until: float,
    between: Callable[[Simulation], None] = lambda _: None,
    options: RecordOptions = ONE_PART,
    actions: Callable[[Simulation], Sequence[RefereeAction]] = lambda _: (),
    silent: Callable[[Simulation], Container[str]] = lambda _: (),
    refbox: Callable[[Simulation], bool] = lambda _: False,
) -> None:
    """Play a real match with the teams that ship, in this process and without a network, and record it.

    `between` is called before each tick, for what operators do, `actions` for what people request of the referee, and
    `silent` for the robots whose agents do not answer, `refbox` for whether a league's referee box is connected.
    """
    medium = SharedState()
    host_bus, bus = medium.open_bus(config.name, SteppedClock()), medium.open_bus(config.name, SteppedClock())
    table, server = InProcessMatch(config), host_bus.serve(SETUP)
    simulation = table.simulation
    host_bus.declare_alive("host", "host")
    batches = BatchPublisher(host_bus)
    outbox = Outbox(batches, simulation.roster, simulation.profile.time.tick)
    debug = DebugPublisher(batches, simulation.profile.time.tick)
    recorder = Recorder(bus, PartSink(path, bus.clock, options), config=config)
    ear = host_bus.subscribe(COMMAND)
    commands = {name: host_bus.publisher(COMMAND, robot=name) for name in table.brains}
    recorder.pump()
    while (query := server.receive()) is not None:
        query.reply(simulation.setup())
    tick = simulation.now
    while True:
        host_bus.clock.sim_ns = round(tick.time * 1e9)
        outbox.publish_tick(tick, simulation.state)
        while (received := ear.receive()) is not None:
            batches.add_received(received)
        batches.end_tick(tick.tick)
        if tick.tick % 25 == 0:
            recorder.pump()
        if simulation.over or tick.time >= until:
            break
        between(simulation)
        outbox.set_roster(simulation.roster)
        playing = {name: brain for name, brain in table.brains.items() if name in tick.sights}
        said = {
            name: Command.decode(brain.act(Sight.decode(tick.sights[name])).encode()) for name, brain in playing.items()
        }
        for name, command in said.items():
            commands[name].put(command)
        debug.publish(said, simulation.roster, simulation.state)
        quiet = silent(simulation)
        answers = {name: command for name, command in said.items() if name not in quiet}
        tick = simulation.step(answers, actions(simulation), silent=quiet, refbox=refbox(simulation))
    batches.send()
    simulation.close()
    host_bus.close()
    recorder.run(lambda: False)


@pytest.fixture(scope="session")
def match_recorder() -> Callable[..., None]:
    """Records any match in this process; see `record_match`."""
    return record_match


@pytest.fixture(scope="session")
def played(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of the first 24 s of a real match of five a side."""
    path = tmp_path_factory.mktemp("played") / "match.mcap"
    record_match(path, load_match(None, {"seed": 1, "duration": 60.0}), until=24.0)
    return path
