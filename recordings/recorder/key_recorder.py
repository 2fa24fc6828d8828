"""Records any keys of a Zenoh network into an MCAP file: payloads as they are, with the times of their arrival."""

from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from recordings.container.encodings import ENCODING, mcap_encoding
from recordings.container.environment import library
from recordings.container.key_selection import KeySelection
from recordings.container.mcap_writer import mcap_writer
from recordings.container.parts import NotWritableError, create_part
from recordings.recorder.key_counts import KEYS, KeyCounts
from recordings.recorder.known_schemas import schema_of
from recordings.recorder.sequence_tracker import SequenceTracker
from recordings.recorder.settings import RecorderSettings
from recordings.timing import FLUSH_S, RECOVERY_POLL_S
from runtime.access.accounts import Account
from runtime.bus.contract import Stamp
from runtime.bus.endpoint import DEFAULT_ENDPOINT
from runtime.bus.find_host import announced_credentials
from runtime.bus.settings import ListenSettings, check_protected
from runtime.bus.zenoh.any_keys import STAMPED, KeySubscription, Sample, open_network
from runtime.bus.zenoh.bus import ZenohBus
from runtime.bus.zenoh.waiting_client import open_when_there
from runtime.process.clock import Clock, WallClock
from runtime.process.timing import PARTING_S
from schemas.errors import TouchlineError

_HALF = 1 << 31
"""Half the range of Zenoh's numbers: a greater step is one backward."""


@dataclass(frozen=True, slots=True)
class KeySummary:
    """What was recorded."""

    path: Path
    keys: int
    messages: int
    losses: dict[str, int]
    """Key → messages that its publishers have numbered and that did not arrive; keys without loss are left out."""
    unwritten: int
    """Messages that had arrived at the end, and for which there was no time."""
    size: int
    """Bytes of the file."""

    @property
    def lost(self) -> int:
        """Messages lost on all keys."""
        return sum(self.losses.values())

    def line(self) -> str:
        """The counts, for the terminal."""
        left = f", {self.unwritten} unwritten: more arrived than could be written" if self.unwritten else ""
        return f"{self.path}: {self.messages} messages on {self.keys} keys, {self.lost} lost, {self.size} bytes{left}"


def record_keys(
    settings: RecorderSettings, should_stop: Callable[[], bool], report: Callable[[str], None]
) -> KeySummary | None:
    """Record until `should_stop` returns true; None if there was no network before that.

    Raises:
        TouchlineError: no network, an expression is none of Zenoh, or a file that cannot be written.
    """
    clock, wanted = WallClock(), settings.record
    if wanted.part_size or wanted.part_duration or wanted.sights:
        raise TouchlineError("--keys records any keys into one file; leave --part-size, --part-duration, --sights out")
    check_protected(ListenSettings(listen=settings.listen, insecure=settings.insecure))
    if settings.listen is not None and settings.connect is not None:
        raise TouchlineError(f"--listen is in place of --connect {settings.connect}; leave one of them out")
    connect = None if settings.listen is not None else settings.connect or DEFAULT_ENDPOINT

    def open_bus(patience: float) -> ZenohBus:
        credentials = settings.credentials
        if connect is not None and credentials is None:
            credentials = announced_credentials(connect, Account.RECORDER)  # a match may be played there
        return open_network("keys", clock, connect, settings.listen, credentials, patience)

    bus = open_when_there(open_bus, clock, settings.patience, report, should_stop)
    if bus is None:
        return None
    with bus:
        selection = KeySelection(tuple(wanted.include), tuple(wanted.exclude))
        recorder = KeyRecorder(bus, settings.out, settings.keys, selection)
        report(f"{' '.join(settings.keys)} at {bus.endpoint} into {settings.out}; end with Ctrl-C")
        return recorder.run(should_stop)


class KeyRecorder:
    """A recorder with its file."""

    def __init__(self, bus: ZenohBus, path: Path, expressions: list[str], selection: KeySelection) -> None:
        """Subscribe, and create the file.

        Raises:
            TouchlineError: an expression is none of Zenoh, or the file cannot be written.
        """
        self._clock: Clock = bus.clock
        self._path, self._expressions, self._selection = path, expressions, selection
        self._subscription = KeySubscription(bus, expressions)
        self._file = create_part(path)
        self._mcap = mcap_writer(self._file)
        self._channels: dict[tuple[str, str], int | None] = {}
        self._number_of_schema = cache(self._mcap.register_schema)
        self._numbers: defaultdict[tuple[str, str], _Numbers] = defaultdict(_Numbers)
        self.messages = 0
        """Messages so far."""

    def run(self, should_stop: Callable[[], bool]) -> KeySummary:
        """Record until `should_stop` returns true, and finish the file.

        Raises:
            NotWritableError: the disk cannot be written; what was written before is readable.
        """
        try:
            self._mcap.start(profile="", library=library())
            flush_at = 0.0
            while not should_stop():
                if not self._write_received():
                    self._clock.sleep_until(self._clock.now() + RECOVERY_POLL_S)
                if self._clock.now() >= flush_at:
                    self._mcap.flush()  # type: ignore[no-untyped-call]
                    self._file.flush()
                    flush_at = self._clock.now() + FLUSH_S
            return self._finish(self._drain())
        except OSError as error:
            reason = error.strerror or "cannot be written"
            raise NotWritableError(self._path, reason, "what was written before is readable") from None
        finally:
            self._file.close()

    def _drain(self) -> int:
        """Write what had arrived at the end, as far as there is time; returns the number of messages left out."""
        self._subscription.close()
        deadline, left = self._clock.now() + PARTING_S, 0
        while self._clock.now() < deadline:
            if not self._write_received():
                return 0
        while samples := self._subscription.receive():
            left += sum(self._selection.includes(sample.key) for sample in samples)
        return left

    def _write_received(self) -> int:
        """Write what has arrived; returns the number of samples."""
        samples = self._subscription.receive()
        for sample in samples:
            now_ns = self._clock.unix_ns()
            known = sample.key, sample.encoding
            channel = self._channels[known] if known in self._channels else self._open_channel(sample)
            if channel is not None:
                sent_ns, number = sample.sent_ns or now_ns, sample.sequence & 0xFFFF_FFFF
                self._mcap.add_message(channel, now_ns, sample.payload, sent_ns, number)
                self.messages += 1
                if sample.writer:
                    self._numbers[sample.key, sample.writer].add(sample, now_ns)
        return len(samples)

    def _open_channel(self, sample: Sample) -> int | None:
        """The channel of a key and an encoding; None for a key that is left out."""
        channel = None
        if self._selection.includes(sample.key):
            encoding, name = mcap_encoding(sample.encoding)
            metadata, known = {"key": sample.key, ENCODING: sample.encoding}, schema_of(encoding, name)
            schema = self._number_of_schema(*known) if known is not None else 0
            channel = self._mcap.register_channel(sample.key, encoding, schema, metadata)
        self._channels[sample.key, sample.encoding] = channel
        return channel

    def _finish(self, unwritten: int) -> KeySummary:
        losses: Counter[str] = Counter()
        for (key, _), numbers in self._numbers.items():
            losses[key] += numbers.lost
        lost = dict(sorted((+losses).items()))
        self._mcap.flush()  # type: ignore[no-untyped-call]
        self._mcap.add_metadata(KEYS, KeyCounts(" ".join(self._expressions), lost, unwritten).metadata())
        self._mcap.finish()  # type: ignore[no-untyped-call]
        self._file.flush()
        keys = {key for (key, _), channel in self._channels.items() if channel is not None}
        return KeySummary(self._path, len(keys), self.messages, lost, unwritten, self._path.stat().st_size)


class _Numbers:
    """The numbers of one writer on one key. Stamps do not name their writer, which is then inferred."""

    def __init__(self) -> None:
        self._expected: int | None = None
        self._lost = 0
        self._stamps = SequenceTracker()

    @property
    def lost(self) -> int:
        """Messages that did not arrive."""
        return self._lost + self._stamps.lost

    def add(self, sample: Sample, now_ns: int) -> None:
        """Count a message."""
        if sample.writer == STAMPED:
            self._stamps.add(Stamp(sample.sequence, sample.sent_ns or now_ns, 0), len(sample.payload))
            return
        step = 0 if self._expected is None else (sample.sequence - self._expected) % (2 * _HALF)
        if step < _HALF:
            self._lost += step
            self._expected = sample.sequence + 1
        else:
            self._lost = max(0, self._lost - 1)  # one that was late
