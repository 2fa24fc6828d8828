"""Records a match from its endpoint into files, by the settings of a recorder."""

from collections.abc import Callable
from pathlib import Path

from recordings.container.key_selection import KeySelection
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.recorder import Recorder, RecordingSummary
from recordings.recorder.settings import RecorderSettings
from recordings.recorder.sink import ONE_FILE, FileLimits, FileSink, Sink
from recordings.recorder.snapshot_sink import SnapshotSink
from schemas.bus.zenoh.bus import open_client
from schemas.process.clock import Clock, WallClock


def record(settings: RecorderSettings, should_stop: Callable[[], bool] = lambda: False) -> RecordingSummary:
    """Record until the host leaves or `should_stop` returns true.

    Raises:
        TouchlineError: no host, or a file that cannot be written; what was written so far stays as `*.part`.
    """
    clock, wanted = WallClock(), settings.record
    selection = KeySelection(tuple(wanted.include), tuple(wanted.exclude))
    with open_client(settings.match, clock, settings.connect, settings.patience) as bus:
        loss_counts = LossCounts()
        sink = open_sink(settings.out, clock, bus.match, loss_counts, FileLimits.of(wanted), viz=wanted.viz)
        try:
            recorder = Recorder(
                bus,
                sink,
                loss_counts,
                name=settings.name,
                sights=wanted.sights,
                selection=selection,
                config=settings.config,
            )
            return recorder.run(should_stop)
        finally:
            sink.abandon()


def open_sink(
    path: Path, clock: Clock, match: str, loss_counts: LossCounts, limits: FileLimits = ONE_FILE, *, viz: bool = True
) -> Sink:
    """The sink of a recording; with `viz`, the channels for viewers are written, too.

    Raises:
        TouchlineError: the file cannot be written.
    """
    return (FileSink if limits.snapshot is None else SnapshotSink)(path, clock, match, loss_counts, limits, viz=viz)
