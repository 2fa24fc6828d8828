"""Records a match from its endpoint into files, by the settings of a recorder."""

from collections.abc import Callable
from pathlib import Path

from recordings.container.key_selection import KeySelection
from recordings.container.manifest import RESULT, Result
from recordings.container.mcap_file import open_mcap_file
from recordings.container.sealed_metadata import from_metadata
from recordings.recorder.file_limits import FileLimits
from recordings.recorder.leftover import Leftover, find_leftover
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.no_match_notice import NoMatchNotice
from recordings.recorder.recorder import Recorder
from recordings.recorder.recording_summary import RecordingSummary
from recordings.recorder.settings import RecorderSettings
from recordings.recorder.sink import FileSink
from schemas.access.accounts import Account
from schemas.bus.contract import Bus, NoReplyError
from schemas.bus.zenoh.bus import ZenohBus, open_client
from schemas.bus.zenoh.waiting_client import open_when_there
from schemas.messages.record_batch import RecordBatchesRequest, read_reply
from schemas.process.clock import WallClock
from schemas.topics import RECORD_BATCHES
from schemas.wire.message import BadMessageError

_ASK_S = 2.0
"""Wall time in which a host answers when it began."""


def record(
    settings: RecorderSettings,
    should_stop: Callable[[], bool] = lambda: False,
    report: Callable[[str], None] = lambda _: None,
) -> RecordingSummary | None:
    """Record until the host leaves or `should_stop` returns true; None if there was no host before that.

    `report` receives a line if there is no host at once, or if it plays another match.

    Raises:
        TouchlineError: no host, or a file that cannot be written; what was written so far stays as `*.part`.
    """
    clock, wanted = WallClock(), settings.record
    selection = KeySelection(tuple(wanted.include), tuple(wanted.exclude))
    limits = FileLimits.of(wanted)

    def connect(patience: float) -> ZenohBus:
        return open_client(settings.match, clock, settings.connect, patience, settings.credentials, Account.RECORDER)

    client = open_when_there(connect, clock, settings.patience, report, should_stop)
    if client is None:
        return None
    with client as bus:
        leftover = _leftover(bus, settings.out, limits) if settings.resume else None
        if leftover is not None and leftover.is_finished and not limits.is_split:
            return _summary_of(leftover.files)
        loss_counts = leftover.loss_counts if leftover is not None else LossCounts()
        sink = FileSink(settings.out, clock, bus.match, loss_counts, limits, viz=wanted.viz, leftover=leftover)
        try:
            recorder = Recorder(
                bus,
                sink,
                loss_counts,
                name=settings.name,
                sights=wanted.sights,
                selection=selection,
                config=settings.config,
                leftover=leftover,
            )
            return recorder.run(NoMatchNotice(bus, report).around(should_stop))
        finally:
            sink.abandon()


def _leftover(bus: Bus, path: Path, limits: FileLimits) -> Leftover:
    """What a killed recorder of this host has left; nothing, if what is there is of an earlier host."""
    leftover = find_leftover(path, limits)
    if leftover.host_ns >= _host_began_ns(bus):
        return leftover
    leftover.release()
    return Leftover()


def _host_began_ns(bus: Bus) -> int:
    """The host's wall time at which it began, ns since 1970; 0 if it does not answer."""
    try:
        payload = bus.query(RECORD_BATCHES, RecordBatchesRequest(first=0, last=0), _ASK_S).payload(_ASK_S)
        return read_reply(payload).stream
    except (NoReplyError, BadMessageError):
        return 0


def _summary_of(files: list[Path]) -> RecordingSummary:
    """The recording that a recorder had finished before it was killed."""
    result = from_metadata(Result, open_mcap_file(files[-1]).metadata[RESULT])
    return RecordingSummary(files, sum(file.stat().st_size for file in files), result)
