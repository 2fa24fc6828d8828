"""Records a match that is played in this process, as the recorder of a match on the bus does."""

from collections.abc import Mapping
from pathlib import Path

from recordings.container.key_selection import KeySelection
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import PresenceKind
from runtime.bus.in_process_bus import SharedState
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions
from schemas.messages.command import Command
from schemas.topics import COMMAND, SETUP
from sim_host.match.simulation import Simulation, TickResult
from sim_host.server.reports.debug_publisher import DebugPublisher
from sim_host.server.reports.outbox import Outbox

_PUMP_TICKS = 25
"""Ticks between two turns of the recorder."""


class MatchRecording:
    """Writes the messages of a match into a file; to be closed."""

    def __init__(self, path: Path, config: MatchConfig, simulation: Simulation) -> None:
        """`simulation` is at tick 0, which is the first one that is recorded.

        Raises:
            TouchlineError: the file cannot be written.
        """
        medium = SharedState()
        self._simulation = simulation
        self._clock = WallClock()
        host, recorder = (medium.open_bus(config.name, clock) for clock in (self._clock, WallClock()))
        wanted = config.record
        self._sink = PartSink(path, recorder.clock, RecordOptions(viz=wanted.viz))
        host.declare_alive(PresenceKind.HOST, "host")
        setup = host.serve(SETUP)
        self._batches = BatchPublisher(host)
        self._outbox = Outbox(self._batches, simulation.roster, simulation.profile.time.tick)
        self._sent = host.subscribe(COMMAND)
        self._debug, self._state = DebugPublisher(self._batches, simulation.profile.time.tick), simulation.state
        self._robots = {name: host.publisher(COMMAND, robot=name) for name in simulation.roster.names}
        self._recorder = Recorder(
            recorder,
            self._sink,
            selection=KeySelection(tuple(wanted.include), tuple(wanted.exclude)),
            config=config,
        )
        self._recorder.pump()  # asks for the setup
        while (query := setup.receive()) is not None:
            query.reply(simulation.setup())
        self.add(simulation.now, {})

    def add(self, tick: TickResult, commands: Mapping[str, Command]) -> None:
        """Record the newest tick, and the commands that led to it."""
        for name, command in commands.items():
            self._robots[name].put(command)  # stamped with the time of their sights
        self._debug.publish(commands, self._simulation.roster, self._state)
        self._state = self._simulation.state
        self._clock.sim_ns = round(tick.time * 1e9)
        self._outbox.set_roster(self._simulation.roster)
        self._outbox.publish_tick(tick, self._simulation.state)
        while (received := self._sent.receive()) is not None:
            self._batches.add_received(received)
        self._batches.end_tick(tick.tick)
        if tick.tick % _PUMP_TICKS == 0:
            self._recorder.pump()

    def close(self) -> None:
        """Finish the file.

        Raises:
            TouchlineError: the file cannot be written.
        """
        self._batches.send()
        self._recorder.pump()
        self._recorder.finish(stopped=not self._simulation.over)
