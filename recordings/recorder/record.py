"""Records a match from its endpoint into files, by the settings of a recorder."""

from collections.abc import Callable

from recordings.container.key_selection import KeySelection
from recordings.container.manifest import EndReason
from recordings.container.parts import parts_of
from recordings.recorder.earlier_parts import read_earlier_parts
from recordings.recorder.no_match_notice import with_no_match_notice
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from recordings.recorder.recording_summary import RecordingSummary
from recordings.recorder.settings import RecorderSettings
from recordings.timing import HOST_ANSWER_S
from runtime.access.accounts import Account
from runtime.bus.contract import Bus, NoReplyError
from runtime.bus.zenoh.bus import ZenohBus, open_client
from runtime.bus.zenoh.waiting_client import open_when_there
from runtime.process.clock import WallClock
from runtime.process.timing import RECONNECT_S
from schemas.messages.record_batch import RecordBatchesReply, RecordBatchesRequest
from schemas.topics import RECORD_BATCHES
from schemas.wire.message import BadMessageError


def record(
    settings: RecorderSettings,
    should_stop: Callable[[], bool] = lambda: False,
    report: Callable[[str], None] = lambda _: None,
) -> RecordingSummary | None:
    """Record until the host leaves or `should_stop` returns true; None if there was no host before that.

    `report` receives a line if there is no host at once, or if it plays another match.

    Raises:
        TouchlineError: no host, or a file that cannot be written; what was written so far stays.
    """
    clock, wanted = WallClock(), settings.record
    selection = KeySelection(tuple(wanted.include), tuple(wanted.exclude))

    def connect(patience: float) -> ZenohBus:
        return open_client(settings.match, clock, settings.connect, patience, settings.credentials, Account.RECORDER)

    client = open_when_there(connect, clock, settings.patience, report, should_stop)
    if client is None:
        return None
    with client as bus:
        host = _stream_of_host(bus, RECONNECT_S if parts_of(settings.out) else HOST_ANSWER_S)
        earlier = read_earlier_parts(settings.out, host)
        if earlier.result is not None and earlier.result.ended is EndReason.FULL_TIME:
            return RecordingSummary(earlier.files, sum(file.stat().st_size for file in earlier.files), earlier.result)
        sink = PartSink(settings.out, clock, wanted, earlier)
        try:
            recorder = Recorder(
                bus,
                sink,
                name=settings.name,
                sights=wanted.sights,
                selection=selection,
                config=settings.config,
                earlier=earlier,
                host=host,
            )
            return recorder.run(with_no_match_notice(bus, report, should_stop))
        finally:
            sink.abandon()


def _stream_of_host(bus: Bus, patience: float) -> int:
    """The stream of the host's record batches; 0 if it does not answer within `patience` s of wall time."""
    limit = bus.clock.now() + patience
    while bus.clock.now() < limit:
        try:
            pending = bus.query(RECORD_BATCHES, RecordBatchesRequest(first=0, last=0), HOST_ANSWER_S)
            return RecordBatchesReply.decode(pending.payload(HOST_ANSWER_S)).stream
        except (NoReplyError, BadMessageError):
            bus.clock.sleep_until(bus.clock.now() + HOST_ANSWER_S / 10)
    return 0
