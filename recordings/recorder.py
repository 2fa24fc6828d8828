"""The recorder: takes everything in that the topic table has recorded, in order and without loss, and writes it.

Knows a bus and a file, no process: `recordings.record` gives it both.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from recordings.head import attachments, date, manifest_of
from recordings.manifest import Ended, Result, to_metadata
from recordings.match_notes import MatchNotes
from recordings.order import SimOrder
from recordings.presence import HostWatch
from recordings.sequences import KeyLedger
from recordings.writer import RecordingWriter
from schemas.bus.contract import Answer, Bus, NoAnswerError, Received
from schemas.host import RecorderProgress, Setup, SetupRequest
from schemas.match_config import MatchConfig
from schemas.message import BadMessageError
from schemas.topics import EVENT, PROGRESS, SETUP, SIGHT, TOPICS, Delivery, Topic

REPORT_TICKS = 25
"""Ticks after which a lockstep host is told at once that they were taken in."""
REPORT_S = 0.05
"""Wall time after which progress is told in any case."""
_POLL_S = 0.02
"""Pause between two looks: many messages at a time cost less than each as it comes."""
_AT_ONCE = 10_000
"""Messages of one topic taken in before the next one's turn."""
_HOLD_NS = 100_000_000
"""Simulated time that a message waits for those of other topics that belong before it."""
_HOLD_S = 0.5
"""Wall time after which it waits no longer: the host stands still."""
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

    path: Path
    size: int
    """Bytes."""
    result: Result


def recorded_topics(sights: bool) -> Iterator[Topic]:
    """The rows that are recorded; sights, when asked for, all of them and not the newest alone."""
    yield from (topic for topic in TOPICS.values() if topic.recorded)
    if sights:
        yield replace(SIGHT, delivery=Delivery.EVERY)


class Recorder:
    """Records one match from a seat on its bus. Listens from the moment it is made."""

    def __init__(
        self,
        bus: Bus,
        writer: RecordingWriter,
        *,
        name: str = "recorder",
        sights: bool = False,
        config: MatchConfig | None = None,
    ) -> None:
        self._bus, self._clock, self._writer = bus, bus.clock, writer
        self._name, self._sights, self._config = name, sights, config
        self._subscriptions = [bus.subscribe(topic) for topic in recorded_topics(sights)]
        self._order = SimOrder()
        self._ledgers: dict[str, KeyLedger] = {}
        self._messages = 0
        self._notes = MatchNotes()
        self._synced_goals = 0
        self._answer: Answer | None = None
        self._asked = self._born = self._clock.now()
        self._ask_pause = _ASK_AGAIN_S[0]
        self._progress = bus.publisher(PROGRESS, name=name)
        self._reported, self._reported_at = -2, self._clock.now()
        self._released_at = self._clock.now()
        self._host = HostWatch(bus)

    def run(self, told_to_stop: Callable[[], bool]) -> RecordingSummary:
        """Record until the host is gone or somebody says stop, take in what is still on its way, and finish."""
        stopped = False
        while not stopped and not self._host.gone(finished=self._notes.finished):
            self.pump()
            self._clock.sleep_until(self._clock.now() + _POLL_S)
            stopped = told_to_stop()
        self.drain(_QUIET_S if stopped else _DRAIN_S)
        return self.finish(stopped)

    def pump(self) -> int:
        """Take in what has come, hand on what is in order, tell how far it is; returns how many messages came."""
        if not self._writer.begun and not self._begin_when_known():
            self._report(idle=True)
            return 0
        came = self._take_in()
        self._hand_on()
        self._report(idle=came == 0)
        return came

    def drain(self, patience: float) -> None:
        """Take in all that is still on its way, until nothing has come for a moment, for `patience` s at most."""
        if not self._writer.begun:
            self._begin(None)
        limit = self._clock.now() + patience
        quiet = self._clock.now() + _QUIET_S
        while self._clock.now() < min(quiet, limit):
            if self.pump():
                quiet = self._clock.now() + _QUIET_S
            else:
                self._clock.sleep_until(self._clock.now() + _POLL_S)

    def finish(self, stopped: bool = False) -> RecordingSummary:
        """Write what is held, and the result; close the file."""
        if not self._writer.begun:
            self._begin(None)
        batch = self._order.release()
        if batch:
            self._writer.write(batch)
        result = self._result(self._ended(stopped))
        return RecordingSummary(self._writer.path, self._writer.finish(to_metadata(result)), result)

    def _ended(self, stopped: bool) -> Ended:
        if self._notes.finished:
            return Ended.FULL_TIME
        return Ended.STOPPED if stopped else Ended.HOST_GONE

    def _hand_on(self) -> None:
        """Give the writer what is in order, or everything when nothing could be given for long; a goal is kept safe."""
        now = self._clock.now()
        waited = now - self._released_at > _HOLD_S
        batch = self._order.release(None if waited else self._order.host_ns - _HOLD_NS)
        if batch or not self._order:
            self._released_at = now
        if batch:
            self._writer.write(batch)
        if self._notes.goals > self._synced_goals and any(received.key == EVENT.key for _, received in batch):
            self._synced_goals = self._notes.goals
            self._writer.sync()

    def _take_in(self) -> int:
        came = 0
        for row, subscription in enumerate(self._subscriptions):
            for _ in range(_AT_ONCE):
                received = subscription.receive()
                if received is None:
                    break
                self._enter(row, received)
                came += 1
        self._messages += came
        self._notes.catch_up()
        return came

    def _enter(self, row: int, received: Received) -> None:
        key = received.key
        ledger = self._ledgers.get(key)
        if ledger is None:
            ledger = self._ledgers[key] = KeyLedger()
        ledger.enter(received.stamp, len(received.payload))
        self._order.add(row, received)
        self._notes.take(received)

    def _report(self, idle: bool) -> None:
        """Tell progress: after a number of ticks, after a while, and when the host seems to wait for it."""
        now = self._clock.now()
        tick = self._notes.tick
        new = tick - self._reported
        if new >= REPORT_TICKS or (idle and new > 0) or now - self._reported_at >= REPORT_S:
            lost = sum(ledger.lost for ledger in self._ledgers.values())
            self._progress.put(RecorderProgress(tick=tick, messages=self._messages, lost=lost))
            self._reported, self._reported_at = tick, now

    def _begin_when_known(self) -> bool:
        """Ask the host how the match is set up, again and again; begin when it has answered."""
        now = self._clock.now()
        if self._answer is None or now - self._asked >= self._ask_pause:
            self._ask_pause = min(2 * self._ask_pause, _ASK_AGAIN_S[1])
            self._answer, self._asked = self._bus.ask(SETUP, SetupRequest(), self._ask_pause), now
        try:
            self._begin(self._answer.result(0.0))
        except NoAnswerError:
            if not self._host.seen:
                self._born = now
            elif now - self._born >= _SETUP_PATIENCE_S:
                self._begin(None)
        except BadMessageError:
            self._notes.unreadable[SETUP.key] += 1
            self._begin(None)
        return self._writer.begun

    def _begin(self, setup: Setup | None) -> None:
        manifest = manifest_of(self._bus.match, self._name, self._clock, setup, self._config, sights=self._sights)
        self._writer.begin(to_metadata(manifest), attachments(self._config))
        self._bus.declare_alive("recorder", self._name)  # from now on a lockstep host waits for this recorder

    def _result(self, ended: Ended) -> Result:
        counts = {key: ledger.count() for key, ledger in sorted(self._ledgers.items())}
        state, applied = self._notes.state, self._notes.applied
        events = counts.get(EVENT.key)
        return Result(
            ended=ended,
            finished=date(self._clock),
            phase=state.phase if state is not None else None,
            score=state.score if state is not None else None,
            clock=state.clock if state is not None else 0.0,
            tick=applied.tick if applied is not None else -1,
            time=applied.time if applied is not None else 0.0,
            events=events.messages if events is not None else 0,
            messages=self._messages,
            lost=sum(count.lost for count in counts.values()),
            missed_before_start=sum(count.missed_before_start for count in counts.values()),
            unreadable=dict(self._notes.unreadable),
            keys=counts,
        )
