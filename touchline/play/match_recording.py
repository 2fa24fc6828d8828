"""Records a match that is played in this process: the messages that its host would publish, without a bus."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from recordings.container.attachments import make_attachments
from recordings.container.key_selection import KeySelection
from recordings.container.manifest import EndReason, Manifest, Result, make_manifest, timestamp
from recordings.recorder.match_progress import FOLLOWED, MatchProgress
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recording_writer import LoggedMessage
from recordings.recorder.roster_metadata import RosterMetadata
from runtime.bus.contract import Publisher, ReceivedMessage, Stamp, full_key
from runtime.process.clock import WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions
from schemas.messages.command import Command
from schemas.topic import Topic
from schemas.topics import COMMAND, SIGHT
from sim_host.match.simulation import Simulation, TickResult
from sim_host.server.reports.debug_publisher import DebugPublisher
from sim_host.server.reports.outbox import Outbox

_WRITE_TICKS = 25
"""Ticks after which messages are passed to the writer."""


class MatchRecording:
    """Writes the messages of a match into a file; to be closed."""

    def __init__(self, path: Path, config: MatchConfig, simulation: Simulation) -> None:
        """`simulation` is at tick 0, which is the first one that is recorded.

        Raises:
            TouchlineError: the file cannot be written.
        """
        wanted, tick_s = config.record, simulation.profile.time.tick
        self.clock = WallClock()
        self._simulation, self._config = simulation, config
        self._selection = KeySelection(tuple(wanted.include), tuple(wanted.exclude))
        self._includes = cache(self._selection.includes)
        self._waiting: list[LoggedMessage] = []
        self._log_ns = 0
        self._progress, roster = MatchProgress(), RosterMetadata(simulation.setup())
        self._progress.roster_changed = roster.update
        self._outbox, self._debug = Outbox(self, simulation.roster, tick_s), DebugPublisher(self, tick_s)
        self._state = simulation.state
        self._robots = {name: self.publisher(COMMAND, robot=name) for name in simulation.roster.names}
        self._sink = PartSink(path, self.clock, RecordOptions(viz=wanted.viz))
        self._sink.begin(self._header, self._result, roster)
        self.add(simulation.now, {})

    def publisher(self, topic: Topic, **chunks: str) -> "_RecordedPublisher":
        """A publisher of the host, or of a robot, whose messages are recorded where the topic is."""
        return _RecordedPublisher(topic, full_key(topic, chunks), self)

    def add_own(self, key: str, payload: bytes, stamp: Stamp) -> None:
        """Record a sight."""
        self.log(ReceivedMessage(SIGHT, key, payload, stamp), stamp.sim_ns)

    def add(self, tick: TickResult, commands: Mapping[str, Command]) -> None:
        """Record the newest tick, and the commands that led to it."""
        sent = [self._robots[name].stamped(command.encode()) for name, command in commands.items()]
        self._debug.publish(commands, self._simulation.roster, self._state)
        self._state = self._simulation.state
        self.clock.sim_ns = round(tick.time * 1e9)
        self._outbox.set_roster(self._simulation.roster)
        self._outbox.publish_tick(tick, self._simulation.state)
        for received in sent:  # stamped with the time of their sights, they arrive now
            self.log(received, self.clock.sim_ns)
        if tick.tick % _WRITE_TICKS == 0:
            self._write()

    def log(self, received: ReceivedMessage, moment_ns: int) -> None:
        """Record a message of this simulated time in ns; log times never run backward."""
        self._log_ns = max(self._log_ns, moment_ns)
        if received.key in FOLLOWED:
            self._progress.update(received)
        if self._includes(received.key):
            self._waiting.append((self._log_ns, received))

    def close(self) -> None:
        """Finish the file.

        Raises:
            TouchlineError: the file cannot be written.
        """
        self._write()
        stopped = EndReason.HOST_GONE if self._simulation.over else EndReason.STOPPED
        self._sink.finish(EndReason.FULL_TIME if self._progress.finished else stopped)

    def _write(self) -> None:
        batch, self._waiting = self._waiting, []
        self._progress.catch_up()
        self._sink.write(batch)

    def _header(self) -> tuple[Manifest, dict[str, bytes]]:
        config, setup = self._config, self._simulation.setup()
        manifest = make_manifest(
            config.name, "recorder", self.clock, setup, config, sights=False, selection=self._selection
        )
        return manifest, make_attachments(config)

    def _result(self, ended: EndReason) -> Result:
        return self._progress.result(ended, timestamp(self.clock), self._sink.loss_counts.counts())


class _RecordedPublisher(Publisher):
    """Publishes into a recording alone."""

    def __init__(self, topic: Topic, key: str, recording: MatchRecording) -> None:
        super().__init__(topic, key)
        self._recording = recording
        self._sequence = 0

    def stamped(self, payload: bytes) -> ReceivedMessage:
        """The next message on this key, as it would be received."""
        clock = self._recording.clock
        stamp = Stamp(self._sequence, clock.unix_ns(), clock.sim_ns)
        self._sequence += 1
        return ReceivedMessage(self.topic, self.key, payload, stamp)

    def put_payload(self, payload: bytes) -> Stamp:
        received = self.stamped(payload)
        assert received.stamp is not None
        self.put_copy(payload, received.stamp)
        return received.stamp

    def put_copy(self, payload: bytes, stamp: Stamp) -> None:
        if self.topic.recorded:
            self._recording.log(ReceivedMessage(self.topic, self.key, payload, stamp), stamp.sim_ns)

    def has_subscribers(self) -> bool:
        return False
