"""The recorder: reads the host's batches in order, and writes the messages in them.

It needs a bus and a sink, no process: `recordings.recorder.record` opens both.
"""

from collections.abc import Callable, Iterable
from functools import cache

from recordings.container.attachments import make_attachments
from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import EndReason, Manifest, Result, make_manifest, timestamp
from recordings.recorder.batch_reader import BatchReader, Unbatcher
from recordings.recorder.earlier_parts import EarlierParts
from recordings.recorder.match_progress import FOLLOWED
from recordings.recorder.part_sink import PartSink
from recordings.recorder.poll_interval import PollInterval
from recordings.recorder.recording_summary import RecordingSummary
from recordings.recorder.recording_writer import LoggedMessage
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.setup_query import SetupQuery
from recordings.timing import DRAINED_S, RECOVERY_POLL_S, REPORT_S
from runtime.bus.contract import Bus, PresenceKind
from runtime.bus.host_watch import HostWatch
from runtime.process.idle_time import run_in_idle_time
from runtime.process.timing import RECONNECT_S
from schemas.config.match_config import MatchConfig
from schemas.messages.record_batch import RecordBatch
from schemas.messages.recorder import RecorderProgress
from schemas.messages.setup import Setup
from schemas.recovery_window import REPORT_TICKS
from schemas.topics import EVENT, RECORD_BATCH, RECORDER_PROGRESS, SETUP
from schemas.wire.message import BadMessageError


class Recorder:
    """Records one match. It subscribes when it is constructed."""

    def __init__(
        self,
        bus: Bus,
        sink: PartSink,
        *,
        name: str = "recorder",
        sights: bool = False,
        selection: KeySelection = EVERYTHING,
        config: MatchConfig | None = None,
        earlier: EarlierParts | None = None,
        host: int = 0,
    ) -> None:
        """Keys that `selection` leaves out are read and not written. `host` is the stream of the host's batches.

        After `earlier` parts, all that follows them and that the host still keeps is recorded.
        """
        self._bus, self._clock, self._sink, self._host_stream = bus, bus.clock, sink, host
        self._name, self._sights, self._selection, self._config = name, sights, selection, config
        before = earlier or EarlierParts()
        self._batches = BatchReader(bus, before.host_ns if before.files else None)
        self._unbatcher = Unbatcher(sights=sights, begins_ns=before.begins_ns)
        self._waiting: list[LoggedMessage] = []
        """Messages that are not written yet, in order."""
        self._tick = -1
        """The newest tick of which all messages were read."""
        self._includes = cache(selection.includes)
        self._roster = RosterMetadata()
        self._setup: Setup | None = None
        self._begun = False
        self._messages = before.messages
        self._match = before.match
        self._synced_goals = 0
        self._progress = bus.publisher(RECORDER_PROGRESS, name=name)
        self._reported_tick, self._reported_at = -2, self._clock.now()
        self._poll_interval = PollInterval(self._clock.now())
        self._host = HostWatch(bus)
        self._setup_query = SetupQuery(bus, self._host)

    def run(self, should_stop: Callable[[], bool]) -> RecordingSummary:
        """Record until the host has left or `should_stop()` is true, read the last messages, and finish.

        A recorder that is stopped while its host is gone has waited for its return: it ends as without one.
        """
        stopped = False

        def poll() -> bool:
            nonlocal stopped
            if self._host_is_gone():
                return True
            self.pump()
            stopped = self._sleep(should_stop)
            return stopped

        run_in_idle_time(poll)
        self._host.update()
        self.drain(DRAINED_S if stopped and self._host.is_reachable() else RECONNECT_S)
        self._host.update()  # which may have gone just before it was told to stop
        return self.finish(stopped and self._host.is_reachable())

    def pump(self) -> int:
        """Read and write the received messages, and report progress; returns the number of messages."""
        if not self._begun and not self._begin_when_known():
            self._report(idle=True)
            return 0
        count = self._read(self._batches.read())
        self._match.catch_up()
        self._write()
        self._report(idle=count == 0)
        return count

    def drain(self, patience: float) -> None:
        """Read messages until none has arrived for `DRAINED_S`, for at most `patience` s.

        Without a link, only messages that have already arrived are read.
        """
        if not self._begun:
            self._begin(None)
        limit = self._clock.now() + patience
        quiet = self._clock.now() + DRAINED_S
        while self._clock.now() < min(quiet, limit):
            if self.pump():
                quiet = self._clock.now() + DRAINED_S
            elif not self._bus.connected():
                break
            else:
                self._clock.sleep_until(self._clock.now() + REPORT_S)
        self._read(self._batches.skip_missing())
        self.pump()

    def _sleep(self, should_stop: Callable[[], bool]) -> bool:
        """Sleep until the next poll or the end of the match; returns whether the recorder must stop."""
        now = self._clock.now()
        until = self._poll_interval.next_poll(now, self._tick)
        if not self._batches.is_complete:
            until = min(until, now + RECOVERY_POLL_S)
        while True:
            self._clock.sleep_until(min(until, now + REPORT_S))
            now = self._clock.now()
            stopped = should_stop()
            if stopped or now >= until or not self._begun or self._is_over():
                return stopped

    def _is_over(self) -> bool:
        """Whether the match is over; its host waits at its end until the recorders have read everything."""
        if not self._match.finished:
            self._read(self._batches.read())
        return self._match.finished

    def finish(self, stopped: bool = False) -> RecordingSummary:
        """Write the remaining messages and the result, and close the file."""
        if not self._begun:
            self._begin(None)
        self._write()
        ended = self._ended(stopped)
        result = self._make_result(ended)
        size = self._sink.finish(ended)
        self._send_progress(leaving=True)
        return RecordingSummary(self._sink.files, size, result)

    def _ended(self, stopped: bool) -> EndReason:
        if self._match.finished:
            return EndReason.FULL_TIME
        return EndReason.STOPPED if stopped else EndReason.HOST_GONE

    def _host_is_gone(self) -> bool:
        """Whether the host has left for good: after a finished match at once, otherwise after `RECONNECT_S`."""
        self._host.update()
        if self._host.is_reachable():
            return False
        return (self._match.finished and self._batches.is_complete) or self._host.is_given_up(RECONNECT_S)

    def _read(self, batches: Iterable[RecordBatch]) -> int:
        """Extract the messages of batches; returns their number."""
        before = self._messages
        for batch in batches:
            self._tick = batch.tick
            try:
                logged = self._unbatcher.messages_of(batch)
            except BadMessageError:
                self._match.unreadable[RECORD_BATCH.key] += 1
                continue
            for _, received in logged:
                if received.key in FOLLOWED:
                    self._match.update(received)
            if self._selection:
                logged = [one for one in logged if self._includes(one[1].key)]
            self._waiting += logged
            self._messages += len(logged)
        return self._messages - before

    def _write(self) -> None:
        """Write the waiting messages; a goal is flushed to the disk."""
        batch, self._waiting = self._waiting, []
        if batch:
            self._sink.write(batch)
        if self._match.goals > self._synced_goals and any(received.key == EVENT.key for _, received in batch):
            self._synced_goals = self._match.goals
            self._sink.sync()

    def _report(self, idle: bool) -> None:
        """Report progress after a number of ticks, after `REPORT_S`, and when no more messages arrive."""
        now = self._clock.now()
        new = self._tick - self._reported_tick
        if new >= REPORT_TICKS or (idle and new > 0) or now - self._reported_at >= REPORT_S:
            self._send_progress()
            self._reported_tick, self._reported_at = self._tick, now

    def _send_progress(self, *, leaving: bool = False) -> None:
        losses = self._sink.loss_counts.losses
        self._progress.put(
            RecorderProgress(
                tick=self._tick,
                messages=self._messages,
                lost=sum(losses.values()),
                losses=losses,
                sights=self._sights,
                leaving=leaving,
            )
        )

    def _begin_when_known(self) -> bool:
        """Begin when the host has replied with the setup, or has not replied in time; returns whether it has begun."""
        if self._setup_query.is_over():
            if self._setup_query.is_unreadable:
                self._match.unreadable[SETUP.key] += 1
            self._begin(self._setup_query.setup)
        return self._begun

    def _begin(self, setup: Setup | None) -> None:
        self._begun, self._setup, self._roster = True, setup, RosterMetadata(setup)
        self._match.roster_changed = self._roster.update
        self._sink.begin(self._make_header, self._make_result, self._roster)
        self._bus.declare_alive(PresenceKind.RECORDER, self._name)  # from now on a lockstep host waits for it
        if self._sights:
            self._send_progress()  # from now on the host adds sights to its batches

    def _make_header(self) -> tuple[Manifest, dict[str, bytes]]:
        manifest = make_manifest(
            self._bus.match,
            self._name,
            self._clock,
            self._setup,
            self._config,
            sights=self._sights,
            selection=self._selection,
            host=self._host_stream,
        )
        return manifest, make_attachments(self._config)

    def _make_result(self, ended: EndReason) -> Result:
        """The result of the recording so far."""
        result = self._match.result(ended, timestamp(self._clock), self._sink.loss_counts.counts())
        unreadable = self._match.unreadable.copy()
        if self._batches.unreadable:
            unreadable[RECORD_BATCH.key] += self._batches.unreadable
        return result.replace(unreadable=dict(unreadable), lost_batches=self._batches.lost)
