"""The recorder: takes everything in that the topic table has recorded, in order and without loss, and writes it.

Knows a bus and a file, no process: `recordings.record` gives it both.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from recordings.account import Account
from recordings.cast import Cast
from recordings.control import Controls
from recordings.head import attachments, date, manifest_of
from recordings.holding import Holding
from recordings.manifest import Ended, Manifest, Result
from recordings.match_notes import MatchNotes
from recordings.minutes import received_of
from recordings.order import SimOrder
from recordings.output import Output
from recordings.presence import HostWatch
from recordings.rest import Rest
from recordings.selection import EVERYTHING, Selection
from recordings.standing import Logged
from schemas.bus.contract import Answer, Bus, NoAnswerError, Received
from schemas.host import RecorderProgress, Setup, SetupRequest
from schemas.idle_time import in_idle_time
from schemas.match_config import MatchConfig
from schemas.message import BadMessageError
from schemas.topic import Delivery, Topic
from schemas.topics import EVENT, MINUTES, PROGRESS, SETUP, SIGHT

REPORT_TICKS = 25
"""Ticks after which a lockstep host is told at once that they were taken in."""
REPORT_S = 0.05
"""Wall time after which progress is told in any case."""
_GLANCE_S = 0.05
"""Wall time after which a recorder that rests hears that somebody asks something of it, or that the match is over."""
_AT_ONCE = 10_000
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


def heard_topics(sights: bool) -> Iterator[Topic]:
    """The rows that a recorder listens to: the host's minutes have everything but sights.

    Sights, when asked for, all of them and not the newest alone; they can be fetched again where the match file has
    them recorded.
    """
    yield MINUTES
    if sights:
        yield replace(SIGHT, delivery=Delivery.RECOVERED)


class Recorder:
    """Records one match from a seat on its bus. Listens from the moment it is made."""

    def __init__(
        self,
        bus: Bus,
        output: Output,
        account: Account,
        *,
        name: str = "recorder",
        sights: bool = False,
        selection: Selection = EVERYTHING,
        config: MatchConfig | None = None,
    ) -> None:
        """`account` is the one that `output` keeps; keys that `selection` leaves out are heard and not written."""
        self._bus, self._clock, self._output, self._account = bus, bus.clock, output, account
        self._name, self._sights, self._selection, self._config = name, sights, selection, config
        self._topics = list(heard_topics(sights))
        self._subscriptions = [bus.subscribe(topic) for topic in self._topics]
        self._order = SimOrder()
        self._wanted: dict[str, bool] = {}
        self._cast = Cast()
        self._setup: Setup | None = None
        self._begun = False
        self._messages = 0
        self._notes = MatchNotes()
        self._synced_goals = 0
        self._answer: Answer | None = None
        self._asked = self._born = self._clock.now()
        self._ask_pause = _ASK_AGAIN_S[0]
        self._progress = bus.publisher(PROGRESS, name=name)
        self._reported, self._reported_at = -2, self._clock.now()
        self._holding = Holding(self._clock.now())
        self._rest = Rest(self._clock.now())
        self._host = HostWatch(bus)
        self._controls = Controls(bus, name, output)

    def run(self, told_to_stop: Callable[[], bool]) -> RecordingSummary:
        """Record until the host is gone or somebody says stop, take in what is still on its way, and finish."""
        stopped = False

        def look() -> bool:
            nonlocal stopped
            if self._host.gone(finished=self._is_whole()):
                return True
            self.pump()
            stopped = self._sleep(told_to_stop)
            return stopped

        in_idle_time(look)
        self.drain(_QUIET_S if stopped else _DRAIN_S)
        return self.finish(stopped)

    def pump(self) -> int:
        """Take in what has come, hand on what is in order, tell how far it is; returns how many messages came."""
        if not self._begun and not self._begin_when_known():
            self._report(idle=True)
            return 0
        came = self._take_in()
        self._hand_on(came)
        self._controls.attend(self._messages, self._account, self._notes.tick)
        self._report(idle=came == 0)
        return came

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
                self._clock.sleep_until(self._clock.now() + _GLANCE_S)
        for subscription in self._subscriptions:
            subscription.forgo()
        self.pump()

    def _sleep(self, told_to_stop: Callable[[], bool]) -> bool:
        """Sleep until it is time to look again, or there is a reason to; returns whether the recorder is to stop."""
        now = self._clock.now()
        until = self._rest.until(now, self._notes.tick)
        while True:
            self._clock.sleep_until(min(until, now + _GLANCE_S))
            now = self._clock.now()
            stopped = told_to_stop()
            if stopped or now >= until or not self._begun or self._controls.asked() or self._is_over():
                return stopped

    def _is_over(self) -> bool:
        """Whether the match is over: a host that ends waits until its recorders have everything."""
        if not self._notes.finished:
            self._take_in_row(self._topics.index(MINUTES))
        return self._notes.finished

    def finish(self, stopped: bool = False) -> RecordingSummary:
        """Write what is held, and the result; close the file."""
        if not self._begun:
            self._begin(None)
        self._write(self._order.release())
        ended = self._ended(stopped)
        result = self._result(ended)
        size = self._output.finish(ended)
        self._tell(leaving=True)
        return RecordingSummary(self._output.files, size, result)

    def _ended(self, stopped: bool) -> Ended:
        if self._notes.finished:
            return Ended.FULL_TIME
        return Ended.STOPPED if stopped else Ended.HOST_GONE

    def _is_whole(self) -> bool:
        """Whether the match is over and all that comes in every tick has come of it."""
        return self._notes.finished and self._order.settled_ns >= self._order.host_ns

    def _hand_on(self, came: int) -> None:
        """Give the writer what is in order; a goal is kept safe."""
        self._holding.look(self._clock.now(), linked=self._bus.connected(), came=came > 0)
        batch = self._order.release(self._holding.limit(self._order.settled_ns))
        if batch or not self._order:
            self._holding.written()
        self._write(batch)
        if self._notes.goals > self._synced_goals and any(received.key == EVENT.key for _, received in batch):
            self._synced_goals = self._notes.goals
            self._output.sync()

    def _write(self, batch: list[Logged]) -> None:
        if batch and self._controls.paused:
            self._output.pass_over(batch)
        elif batch:
            self._output.write(batch)

    def _take_in(self) -> int:
        came = sum(map(self._take_in_row, range(len(self._topics))))
        self._notes.catch_up()
        return came

    def _take_in_row(self, row: int) -> int:
        """Take in what waits of a topic, or all that the host's minutes hold; returns how many messages that were."""
        messages = list(islice(iter(self._subscriptions[row].receive, None), _AT_ONCE))
        if not messages:
            return 0
        if self._topics[row] is MINUTES:
            messages = [entry for received in messages for entry in self._unpacked(received)]
            self._notes.take(messages)
        if self._selection:
            messages = [received for received in messages if self._wants(received)]
        self._order.add(messages)
        self._messages += len(messages)
        return len(messages)

    def _wants(self, received: Received) -> bool:
        """Whether a message is to be written; one that is not says how far the host is, and no more."""
        key = received.key
        wanted = self._wanted.get(key)
        if wanted is None:
            wanted = self._wanted[key] = self._selection.wants(key)
        if not wanted:
            self._order.reach(received)
        return wanted

    def _unpacked(self, minutes: Received) -> list[Received]:
        try:
            entries = received_of(minutes)
        except BadMessageError:
            self._notes.unreadable[MINUTES.key] += 1
            return []
        self._order.settle(minutes)
        return entries

    def _report(self, idle: bool) -> None:
        """Tell progress: after a number of ticks, after a while, and when the host seems to wait for it."""
        now = self._clock.now()
        tick = self._notes.tick_at(self._order.settled_ns)
        new = tick - self._reported
        if new >= REPORT_TICKS or (idle and new > 0) or now - self._reported_at >= REPORT_S:
            self._tell()
            self._reported, self._reported_at = tick, now

    def _tell(self, *, leaving: bool = False) -> None:
        losses = self._account.losses
        self._progress.put(
            RecorderProgress(
                tick=self._notes.tick_at(self._order.settled_ns),
                messages=self._messages,
                lost=sum(losses.values()),
                losses=losses,
                paused=self._controls.paused,
                leaving=leaving,
            )
        )

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
        return self._begun

    def _begin(self, setup: Setup | None) -> None:
        self._begun, self._setup, self._cast = True, setup, Cast(setup)
        self._notes.follow_roster(self._cast.follow)
        self._output.begin(self._head, self._result, self._cast)
        self._bus.declare_alive("recorder", self._name)  # from now on a lockstep host waits for this recorder

    def _head(self) -> tuple[Manifest, dict[str, bytes]]:
        manifest = manifest_of(
            self._bus.match,
            self._name,
            self._clock,
            self._setup,
            self._config,
            sights=self._sights,
            selection=self._selection,
        )
        return manifest, attachments(self._config)

    def _result(self, ended: Ended) -> Result:
        """How the file ends that is being written."""
        state, applied = self._notes.state, self._notes.applied
        result = Result(
            ended=ended,
            finished=date(self._clock),
            phase=state.phase if state is not None else None,
            score=state.score if state is not None else None,
            clock=state.clock if state is not None else 0.0,
            tick=applied.tick if applied is not None else -1,
            time=applied.time if applied is not None else 0.0,
            unreadable=dict(self._notes.unreadable),
        )
        return result.counted(self._account.of_this_file())
