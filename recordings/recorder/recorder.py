"""The recorder: reads all that the topic table has recorded from the host's batches, in order, and writes it.

Knows a bus and a file, no process: `recordings.recorder.record` gives it both.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from recordings.container.attachments import make_attachments
from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import EndReason, Manifest, Result, make_manifest, timestamp
from recordings.recorder.batch_reader import BatchReader
from recordings.recorder.control_service import ControlService
from recordings.recorder.latched_messages import LoggedMessage
from recordings.recorder.leftover import Leftover, message_id
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.poll_interval import PollInterval
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sink import Sink
from recordings.recorder.unbatch import Unbatcher
from schemas.bus.contract import Bus, NoReplyError, PendingReply, PresenceKind
from schemas.bus.host_watch import RECONNECT_S, HostWatch
from schemas.config.match_config import MatchConfig
from schemas.messages.record_batch import Batch
from schemas.messages.recorder import RecorderProgress
from schemas.messages.setup import Setup, SetupRequest
from schemas.process.idle_time import run_in_idle_time
from schemas.recovery_window import REPORT_TICKS
from schemas.topics import EVENT, RECORD_BATCH, RECORDER_PROGRESS, SETUP
from schemas.wire.message import BadMessageError

REPORT_S = 0.05
"""Wall time after which progress is reported in any case."""
_CHECK_S = 0.05
"""Wall time after which a recorder that rests looks for questions, and for the end of the match."""
_RECOVERS_S = 0.01
"""Wall time between two looks while batches are missing."""
_ASK_AGAIN_S = (0.1, 1.6)
"""Pause before the host is asked again: the first, and the longest it doubles to."""
_SETUP_PATIENCE_S = 10.0
"""Wall time that a host is given to say how the match is set up; then the recording begins without."""
_QUIET_S = 0.25
"""Wall time without a message after which nothing more is on its way."""
_DRAIN_S = 10.0
"""Wall time that taking in the rest may last after the host has left; a host that goes on would never end it."""


@dataclass(frozen=True, slots=True)
class RecordingSummary:
    """What was recorded."""

    files: list[Path]
    """What is left of it, the oldest first."""
    size: int
    """Bytes in all of them."""
    result: Result
    """Of the last file, or of all that was seen where snapshots were taken."""


class Recorder:
    """Records one match from a seat on its bus. Listens from the moment it is made."""

    def __init__(
        self,
        bus: Bus,
        sink: Sink,
        loss_counts: LossCounts,
        *,
        name: str = "recorder",
        sights: bool = False,
        selection: KeySelection = EVERYTHING,
        config: MatchConfig | None = None,
        leftover: Leftover | None = None,
    ) -> None:
        """`loss_counts` is the one that `sink` keeps; keys that `selection` leaves out are read and not written.

        With a `leftover`, the recording of a killed recorder is continued with all that the host still keeps.
        """
        self._bus, self._clock, self._sink, self._loss_counts = bus, bus.clock, sink, loss_counts
        self._name, self._sights, self._selection, self._config = name, sights, selection, config
        left = leftover or Leftover()
        self._batches = BatchReader(bus, left.host_ns if leftover is not None else None)
        self._unbatcher = Unbatcher(sights=sights, log_ns=max(0, left.last_ns))
        self._leftover: Leftover | None = leftover
        self._written = frozenset(left.newest)
        """Messages that the killed recorder has written, among the newest."""
        self._waiting: list[LoggedMessage] = []
        """Messages in order that are not written yet."""
        self._tick = -1
        """The newest tick that was read to its end."""
        self._wanted: dict[str, bool] = {}
        self._roster = RosterMetadata()
        self._setup: Setup | None = None
        self._begun = False
        self._messages = left.messages
        self._match = left.match
        self._synced_goals = 0
        self._answer: PendingReply | None = None
        self._asked_at = self._unanswered_since = self._clock.now()
        self._ask_pause = _ASK_AGAIN_S[0]
        self._progress = bus.publisher(RECORDER_PROGRESS, name=name)
        self._reported_tick, self._reported_at = -2, self._clock.now()
        self._poll_interval = PollInterval(self._clock.now())
        self._host = HostWatch(bus)
        self._control_service = ControlService(bus, name, sink)

    def run(self, should_stop: Callable[[], bool]) -> RecordingSummary:
        """Record until the host is gone or somebody says stop, take in what is still on its way, and finish."""
        stopped = False

        def poll() -> bool:
            nonlocal stopped
            if self._host_is_gone():
                return True
            self.pump()
            stopped = self._sleep(should_stop)
            return stopped

        run_in_idle_time(poll)
        self.drain(_QUIET_S if stopped else _DRAIN_S)
        return self.finish(stopped)

    def pump(self) -> int:
        """Read what has come, write it, report progress; returns how many messages came."""
        if not self._begun and not self._begin_when_known():
            self._report(idle=True)
            return 0
        count = self._read(self._batches.read())
        self._match.catch_up()
        self._write()
        self._control_service.answer_requests(self._messages, self._loss_counts, self._tick)
        self._report(idle=count == 0)
        return count

    def drain(self, patience: float) -> None:
        """Take in all that is still on its way, until nothing has come for a moment, for `patience` s at most.

        Without a link nothing is on its way but what has come already.
        """
        if not self._begun:
            self._begin(None)
        limit = self._clock.now() + patience
        quiet = self._clock.now() + _QUIET_S
        while self._clock.now() < min(quiet, limit):
            if self.pump():
                quiet = self._clock.now() + _QUIET_S
            elif not self._bus.connected():
                break
            else:
                self._clock.sleep_until(self._clock.now() + _CHECK_S)
        self._read(self._batches.skip_missing())
        self.pump()

    def _sleep(self, should_stop: Callable[[], bool]) -> bool:
        """Sleep until it is time to look again, or there is a reason to; returns whether the recorder is to stop."""
        now = self._clock.now()
        until = self._poll_interval.next_poll(now, self._tick)
        if not self._batches.is_complete:
            until = min(until, now + _RECOVERS_S)
        while True:
            self._clock.sleep_until(min(until, now + _CHECK_S))
            now = self._clock.now()
            stopped = should_stop()
            if stopped or now >= until or not self._begun or self._control_service.has_requests() or self._is_over():
                return stopped

    def _is_over(self) -> bool:
        """Whether the match is over: a host that ends waits until its recorders have everything."""
        if not self._match.finished:
            self._read(self._batches.read())
        return self._match.finished

    def finish(self, stopped: bool = False) -> RecordingSummary:
        """Write what waits, and the result; close the file."""
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
        """Whether the host was there and will not come back; after a finished match its absence is its farewell."""
        self._host.update()
        if self._host.is_reachable():
            return False
        return self._is_complete() or self._host.unreachable_s() >= RECONNECT_S

    def _is_complete(self) -> bool:
        """Whether the match is over and nothing is known to be missing of it."""
        return self._match.finished and self._batches.is_complete

    def _read(self, batches: Iterable[Batch]) -> int:
        """Take batches apart; returns how many messages wait to be written now, beside those that waited before."""
        before = self._messages
        for batch in batches:
            self._tick = batch.tick
            try:
                logged = self._unbatcher.messages_of(batch)
            except BadMessageError:
                self._match.unreadable[RECORD_BATCH.key] += 1
                continue
            if self._written:
                logged = [one for one in logged if message_id(one[1]) not in self._written]
            self._match.update(received for _, received in logged)
            if self._selection:
                logged = [one for one in logged if self._includes(one[1].key)]
            self._waiting += logged
            self._messages += len(logged)
        return self._messages - before

    def _write(self) -> None:
        """Give the output what waits; a goal is kept safe."""
        batch, self._waiting = self._waiting, []
        if batch and self._control_service.paused:
            self._sink.skip(batch)
        elif batch:
            self._sink.write(batch)
        if self._match.goals > self._synced_goals and any(received.key == EVENT.key for _, received in batch):
            self._synced_goals = self._match.goals
            self._sink.sync()

    def _includes(self, key: str) -> bool:
        """Whether the messages of a key are to be written."""
        wanted = self._wanted.get(key)
        if wanted is None:
            wanted = self._wanted[key] = self._selection.includes(key)
        return wanted

    def _report(self, idle: bool) -> None:
        """Report progress: after a number of ticks, after a while, and when the host seems to wait for it."""
        now = self._clock.now()
        new = self._tick - self._reported_tick
        if new >= REPORT_TICKS or (idle and new > 0) or now - self._reported_at >= REPORT_S:
            self._send_progress()
            self._reported_tick, self._reported_at = self._tick, now

    def _send_progress(self, *, leaving: bool = False) -> None:
        losses = self._loss_counts.losses
        self._progress.put(
            RecorderProgress(
                tick=self._tick,
                messages=self._messages,
                lost=sum(losses.values()),
                losses=losses,
                sights=self._sights,
                paused=self._control_service.paused,
                leaving=leaving,
            )
        )

    def _begin_when_known(self) -> bool:
        """Ask the host how the match is set up, again and again; begin when it has answered."""
        now = self._clock.now()
        if self._answer is None or now - self._asked_at >= self._ask_pause:
            self._ask_pause = min(2 * self._ask_pause, _ASK_AGAIN_S[1])
            self._answer, self._asked_at = self._bus.query(SETUP, SetupRequest(), self._ask_pause), now
        try:
            self._begin(self._answer.result(0.0))
        except NoReplyError:
            if not self._host.seen:
                self._unanswered_since = now
            elif now - self._unanswered_since >= _SETUP_PATIENCE_S:
                self._begin(None)
        except BadMessageError:
            self._match.unreadable[SETUP.key] += 1
            self._begin(None)
        return self._begun

    def _begin(self, setup: Setup | None) -> None:
        self._begun, self._setup, self._roster = True, setup, RosterMetadata(setup)
        self._match.on_roster_change(self._roster.update)
        if self._leftover is not None:
            self._match.update(received for _, received in self._leftover.latched.messages())
            self._match.catch_up()
        self._sink.begin(self._make_header, self._make_result, self._roster)
        self._bus.declare_alive(PresenceKind.RECORDER, self._name)  # a lockstep host waits for it from now on
        if self._sights:
            self._send_progress()  # from now on the host puts sights into its batches

    def _make_header(self) -> tuple[Manifest, dict[str, bytes]]:
        manifest = make_manifest(
            self._bus.match,
            self._name,
            self._clock,
            self._setup,
            self._config,
            sights=self._sights,
            selection=self._selection,
        )
        return manifest, make_attachments(self._config)

    def _make_result(self, ended: EndReason) -> Result:
        """How the file ends that is being written."""
        state, applied = self._match.state, self._match.applied
        result = Result(
            ended=ended,
            finished=timestamp(self._clock),
            phase=state.phase if state is not None else None,
            score=state.score if state is not None else None,
            clock=state.clock if state is not None else 0.0,
            tick=applied.tick if applied is not None else -1,
            time=applied.time if applied is not None else 0.0,
            unreadable=self._unreadable(),
            lost_batches=self._batches.lost,
        )
        return result.counted(self._loss_counts.for_this_file())

    def _unreadable(self) -> dict[str, int]:
        """Payloads that could not be read, by key."""
        counts = self._match.unreadable.copy()
        if self._batches.unreadable:
            counts[RECORD_BATCH.key] += self._batches.unreadable
        return dict(counts)
