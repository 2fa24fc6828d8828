"""The recorder: takes everything in that the topic table has recorded, in order and without loss, and writes it.

Knows a bus and a file, no process: `recordings.recorder.record` gives it both.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from recordings.container.attachments import make_attachments
from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.container.manifest import EndReason, Manifest, Result, make_manifest, timestamp
from recordings.recorder.control_service import ControlService
from recordings.recorder.host_watch import HostWatch
from recordings.recorder.latched_messages import LoggedMessage
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.match_progress import MatchProgress
from recordings.recorder.poll_interval import PollInterval
from recordings.recorder.reorder_buffer import ReorderBuffer
from recordings.recorder.reorder_window import ReorderWindow
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.recorder.sink import Sink
from recordings.recorder.unbatch import unbatch
from schemas.bus.contract import Bus, NoReplyError, PendingReply, ReceivedMessage
from schemas.config.match_config import MatchConfig
from schemas.message import BadMessageError
from schemas.messages.host import RecorderProgress, Setup, SetupRequest
from schemas.process.idle_time import run_in_idle_time
from schemas.topic import Delivery, Topic
from schemas.topics import EVENT, RECORD_BATCH, RECORDER_PROGRESS, SETUP, SIGHT

REPORT_TICKS = 25
"""Ticks after which a lockstep host is told at once that they were taken in."""
REPORT_S = 0.05
"""Wall time after which progress is told in any case."""
_CHECK_S = 0.05
"""Wall time after which a recorder that rests hears that somebody asks something of it, or that the match is over."""
_MAX_AT_ONCE = 10_000
"""Messages of one topic taken in before the next one's turn."""
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


def subscribed_topics(sights: bool) -> Iterator[Topic]:
    """The rows that a recorder listens to: the host's record batches have everything but sights.

    Sights, when asked for, all of them and not the newest alone; they can be fetched again where the match file has
    them recorded.
    """
    yield RECORD_BATCH
    if sights:
        yield replace(SIGHT, delivery=Delivery.RECOVERED)


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
    ) -> None:
        """`loss_counts` is the one that `sink` keeps; keys that `selection` leaves out are heard and not written."""
        self._bus, self._clock, self._sink, self._loss_counts = bus, bus.clock, sink, loss_counts
        self._name, self._sights, self._selection, self._config = name, sights, selection, config
        self._topics = list(subscribed_topics(sights))
        self._subscriptions = [bus.subscribe(topic) for topic in self._topics]
        self._buffer = ReorderBuffer()
        self._wanted: dict[str, bool] = {}
        self._roster = RosterMetadata()
        self._setup: Setup | None = None
        self._begun = False
        self._messages = 0
        self._match = MatchProgress()
        self._synced_goals = 0
        self._answer: PendingReply | None = None
        self._asked_at = self._unanswered_since = self._clock.now()
        self._ask_pause = _ASK_AGAIN_S[0]
        self._progress = bus.publisher(RECORDER_PROGRESS, name=name)
        self._reported_tick, self._reported_at = -2, self._clock.now()
        self._window = ReorderWindow(self._clock.now())
        self._poll_interval = PollInterval(self._clock.now())
        self._host = HostWatch(bus)
        self._control_service = ControlService(bus, name, sink)

    def run(self, should_stop: Callable[[], bool]) -> RecordingSummary:
        """Record until the host is gone or somebody says stop, take in what is still on its way, and finish."""
        stopped = False

        def poll() -> bool:
            nonlocal stopped
            if self._host.gone(finished=self._is_complete()):
                return True
            self.pump()
            stopped = self._sleep(should_stop)
            return stopped

        run_in_idle_time(poll)
        self.drain(_QUIET_S if stopped else _DRAIN_S)
        return self.finish(stopped)

    def pump(self) -> int:
        """Take in what has come, hand on what is in order, tell how far it is; returns how many messages came."""
        if not self._begun and not self._begin_when_known():
            self._report(idle=True)
            return 0
        count = self._receive()
        self._write_reordered(count)
        self._control_service.answer_requests(self._messages, self._loss_counts, self._match.tick)
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
        for subscription in self._subscriptions:
            subscription.skip_missing()
        self.pump()

    def _sleep(self, should_stop: Callable[[], bool]) -> bool:
        """Sleep until it is time to look again, or there is a reason to; returns whether the recorder is to stop."""
        now = self._clock.now()
        until = self._poll_interval.next_poll(now, self._match.tick)
        while True:
            self._clock.sleep_until(min(until, now + _CHECK_S))
            now = self._clock.now()
            stopped = should_stop()
            if stopped or now >= until or not self._begun or self._control_service.has_requests() or self._is_over():
                return stopped

    def _is_over(self) -> bool:
        """Whether the match is over: a host that ends waits until its recorders have everything."""
        if not self._match.finished:
            self._receive_topic(self._topics.index(RECORD_BATCH))
        return self._match.finished

    def finish(self, stopped: bool = False) -> RecordingSummary:
        """Write what is held, and the result; close the file."""
        if not self._begun:
            self._begin(None)
        self._write(self._buffer.release())
        ended = self._ended(stopped)
        result = self._make_result(ended)
        size = self._sink.finish(ended)
        self._send_progress(leaving=True)
        return RecordingSummary(self._sink.files, size, result)

    def _ended(self, stopped: bool) -> EndReason:
        if self._match.finished:
            return EndReason.FULL_TIME
        return EndReason.STOPPED if stopped else EndReason.HOST_GONE

    def _is_complete(self) -> bool:
        """Whether the match is over and all that comes in every tick has come of it."""
        return self._match.finished and self._buffer.complete_ns >= self._buffer.host_ns

    def _write_reordered(self, count: int) -> None:
        """Give the writer what is in order; a goal is kept safe."""
        self._window.update(self._clock.now(), linked=self._bus.connected(), received=count > 0)
        batch = self._buffer.release(self._window.limit(self._buffer.complete_ns))
        if batch or not self._buffer:
            self._window.mark_written()
        self._write(batch)
        if self._match.goals > self._synced_goals and any(received.key == EVENT.key for _, received in batch):
            self._synced_goals = self._match.goals
            self._sink.sync()

    def _write(self, batch: list[LoggedMessage]) -> None:
        if batch and self._control_service.paused:
            self._sink.skip(batch)
        elif batch:
            self._sink.write(batch)

    def _receive(self) -> int:
        count = sum(map(self._receive_topic, range(len(self._topics))))
        self._match.catch_up()
        return count

    def _receive_topic(self, index: int) -> int:
        """Take in what waits of a topic, or all that record batches hold; returns how many messages that were."""
        messages = list(islice(iter(self._subscriptions[index].receive, None), _MAX_AT_ONCE))
        if not messages:
            return 0
        if self._topics[index] is RECORD_BATCH:
            messages = [entry for received in messages for entry in self._unbatch(received)]
            self._match.update(messages)
        if self._selection:
            messages = [received for received in messages if self._includes(received)]
        self._buffer.add(messages)
        self._messages += len(messages)
        return len(messages)

    def _includes(self, received: ReceivedMessage) -> bool:
        """Whether a message is to be written; one that is not says how far the host is, and no more."""
        key = received.key
        wanted = self._wanted.get(key)
        if wanted is None:
            wanted = self._wanted[key] = self._selection.includes(key)
        if not wanted:
            self._buffer.note_host_time(received)
        return wanted

    def _unbatch(self, batch: ReceivedMessage) -> list[ReceivedMessage]:
        try:
            entries = unbatch(batch)
        except BadMessageError:
            self._match.unreadable[RECORD_BATCH.key] += 1
            return []
        self._buffer.advance(batch)
        return entries

    def _report(self, idle: bool) -> None:
        """Tell progress: after a number of ticks, after a while, and when the host seems to wait for it."""
        now = self._clock.now()
        tick = self._match.tick_at(self._buffer.complete_ns)
        new = tick - self._reported_tick
        if new >= REPORT_TICKS or (idle and new > 0) or now - self._reported_at >= REPORT_S:
            self._send_progress()
            self._reported_tick, self._reported_at = tick, now

    def _send_progress(self, *, leaving: bool = False) -> None:
        losses = self._loss_counts.losses
        self._progress.put(
            RecorderProgress(
                tick=self._match.tick_at(self._buffer.complete_ns),
                messages=self._messages,
                lost=sum(losses.values()),
                losses=losses,
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
        self._sink.begin(self._make_header, self._make_result, self._roster)
        self._bus.declare_alive("recorder", self._name)  # from now on a lockstep host waits for this recorder

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
            unreadable=dict(self._match.unreadable),
        )
        return result.counted(self._loss_counts.for_this_file())
