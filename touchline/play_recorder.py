"""Records a match in one process, by the recorder that records matches on a network."""

from pathlib import Path

from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.record import open_sink
from recordings.recorder.recorder import Recorder
from schemas.bus.batch_publisher import BatchPublisher
from schemas.bus.contract import PresenceKind
from schemas.bus.in_process_bus import SharedState
from schemas.process.clock import WallClock
from schemas.topics import COMMAND, SETUP
from sim_host.match.simulation import TickResult
from sim_host.server.outbox import Outbox
from touchline.play import InProcessMatch

_PUMP_TICKS = 25
"""Ticks between two writes."""


class PlayRecorder:
    """Writes the recording of a match that has just begun."""

    def __init__(self, match: InProcessMatch, path: Path) -> None:
        """The file is `path`, and until `finish` the same with `.part`.

        Raises:
            TouchlineError: the file cannot be written.
        """
        config, simulation = match.simulation.config, match.simulation
        medium, clock = SharedState(), WallClock()
        self._match, self._host = match, medium.open_bus(config.name, clock)
        self._batches = BatchPublisher(self._host)
        self._outbox = Outbox(self._batches, simulation.roster, simulation.profile.time.tick)
        self._commands_received = self._host.subscribe(COMMAND)
        self._commands = {name: self._host.publisher(COMMAND, robot=name) for name in match.brains}
        setup = self._host.serve(SETUP)
        self._host.declare_alive(PresenceKind.HOST, "host")
        loss_counts = LossCounts()
        self._bus = medium.open_bus(config.name, clock)
        self._sink = open_sink(path, clock, config.name, loss_counts, viz=config.record.viz)
        self._recorder = Recorder(self._bus, self._sink, loss_counts, config=config)
        self._recorder.pump()
        while (query := setup.receive()) is not None:
            query.reply(simulation.setup())
        self.add(simulation.now)

    def add(self, tick: TickResult) -> None:
        """Record the newest tick, and the commands that led to it."""
        self._host.clock.sim_ns = round(tick.time * 1e9)
        for name, command in self._match.commands.items():
            self._commands[name].put(command)
        while (received := self._commands_received.receive()) is not None:
            self._batches.add_received(received)
        self._outbox.publish_tick(tick, self._match.simulation.state)
        self._batches.end_tick(tick.tick)
        if tick.tick % _PUMP_TICKS == 0:
            self._recorder.pump()

    def finish(self) -> None:
        """Write what is left, and close the file."""
        self._batches.send()
        self._recorder.pump()
        self._host.close()
        self._recorder.drain(0.0)
        self._recorder.finish()
        self._bus.close()

    def abandon(self) -> None:
        """Leave the unfinished file with what was recorded; without effect after `finish`."""
        self._sink.abandon()
