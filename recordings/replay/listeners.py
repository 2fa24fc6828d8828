"""The listeners of a replay: recorders, which limit its speed, and others, which need the latched messages."""

from recordings.reading.recording import RecordedMessage
from recordings.timing import RECORDER_PATIENCE_S
from runtime.bus.contract import Bus, PresenceKind
from schemas.recovery_window import RUN_AHEAD_TICKS
from schemas.topics import APPLIED, RECORDER_PROGRESS
from schemas.wire.message import valid

_HOSTS = (PresenceKind.HOST, PresenceKind.REPLAY)


class _Recorder:
    """Progress of one recorder."""

    def __init__(self, now: float) -> None:
        self.tick = -1
        self.confirmed_at = now
        self.is_given_up = False
        self.unconfirmed: list[int] = []
        """Published ticks that it has not confirmed."""


class Listeners:
    """Follows the listeners by their liveliness tokens."""

    def __init__(self, bus: Bus, tick_ns: float) -> None:
        """`tick_ns` is the duration of a tick in ns."""
        self._clock = bus.clock
        self._tick_ns = tick_ns
        self._watch = bus.watch_alive()
        self._progress = bus.subscribe(RECORDER_PROGRESS)
        self.recorders: dict[str, _Recorder] = {}

    def update(self) -> bool:
        """Receive arrivals, departures and progress of recorders; returns whether a listener arrived."""
        came = False
        while (presence := self._watch.receive()) is not None:
            came = came or (presence.alive and presence.kind not in _HOSTS)
            if presence.kind is PresenceKind.RECORDER and presence.alive:
                self.recorders[presence.name] = _Recorder(self._clock.now())
            elif presence.kind is PresenceKind.RECORDER:
                self.recorders.pop(presence.name, None)
        while (received := self._progress.receive()) is not None:
            recorder = self.recorders.get(received.chunks["name"])
            if recorder is not None and (progress := valid(received.message)) is not None:
                self._confirm(recorder, progress.tick)
        return came

    def note_published(self, recorded: RecordedMessage) -> None:
        """Note a published message; recorders confirm ticks by their `host/applied`."""
        if recorded.topic is APPLIED and self.recorders:
            tick = round(recorded.log_ns / self._tick_ns)
            for recorder in [one for one in self.recorders.values() if not one.is_given_up]:
                if not recorder.unconfirmed:
                    recorder.confirmed_at = self._clock.now()
                recorder.unconfirmed.append(tick)

    def can_publish(self) -> bool:
        """Whether another tick may be published; False while a recorder is too far behind."""
        late = [recorder for recorder in self.recorders.values() if len(recorder.unconfirmed) > RUN_AHEAD_TICKS]
        if not late:
            return True
        self.update()
        return not any(
            len(recorder.unconfirmed) > RUN_AHEAD_TICKS and self._is_waited_for(recorder) for recorder in late
        )

    def any_behind(self) -> bool:
        """Whether a recorder that makes progress has ticks to confirm."""
        return any(recorder.unconfirmed and self._is_waited_for(recorder) for recorder in self.recorders.values())

    def _confirm(self, recorder: _Recorder, tick: int) -> None:
        if tick in recorder.unconfirmed:
            del recorder.unconfirmed[: recorder.unconfirmed.index(tick) + 1]
        if tick != recorder.tick:
            recorder.tick, recorder.confirmed_at, recorder.is_given_up = tick, self._clock.now(), False

    def _is_waited_for(self, recorder: _Recorder) -> bool:
        if self._clock.now() - recorder.confirmed_at > RECORDER_PATIENCE_S and not recorder.is_given_up:
            recorder.is_given_up = True
            recorder.unconfirmed.clear()
        return not recorder.is_given_up
