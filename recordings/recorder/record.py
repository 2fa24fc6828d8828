"""Records a match from its endpoint into a file: what `touchline record` and `python -m recordings` do."""

from collections.abc import Callable
from pathlib import Path

from recordings.container.key_selection import EVERYTHING, KeySelection
from recordings.recorder.loss_counts import LossCounts
from recordings.recorder.recorder import Recorder, RecordingSummary
from recordings.recorder.sink import ONE_FILE, FileLimits, FileSink, Sink
from recordings.recorder.snapshot_sink import SnapshotSink
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.zenoh.bus import open_client
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.process.clock import Clock, WallClock


def record(
    connect: str = DEFAULT_ENDPOINT,
    match: str = "friendly",
    out: Path = Path("match.mcap"),
    *,
    name: str = "recorder",
    sights: bool = False,
    selection: KeySelection = EVERYTHING,
    limits: FileLimits = ONE_FILE,
    config: MatchConfig | None = None,
    viz: bool = True,
    patience: float = 30.0,
    should_stop: Callable[[], bool] = lambda: False,
) -> RecordingSummary:
    """Record until the host leaves or `should_stop` says so; `patience` is how long the host may take to appear, in s.

    With `viz`, what viewers draw is in the file beside the messages.

    Raises:
        TouchlineError: no host, or a file that cannot be written; what was written so far stays as `*.part`.
    """
    clock = WallClock()
    with open_client(match, clock, connect, patience) as bus:
        loss_counts = LossCounts()
        sink = open_sink(out, clock, match, loss_counts, limits, viz=viz)
        try:
            recorder = Recorder(bus, sink, loss_counts, name=name, sights=sights, selection=selection, config=config)
            return recorder.run(should_stop)
        finally:
            sink.abandon()


def open_sink(
    path: Path, clock: Clock, match: str, loss_counts: LossCounts, limits: FileLimits = ONE_FILE, *, viz: bool = True
) -> Sink:
    """Where a recording goes; with `viz`, what viewers draw is in it.

    Raises:
        TouchlineError: a file that cannot be written.
    """
    return (FileSink if limits.snapshot is None else SnapshotSink)(path, clock, match, loss_counts, limits, viz=viz)


def read_config(path: Path) -> MatchConfig:
    """The match file as the one who started the match wrote it down, in JSON.

    Raises:
        TouchlineError: no such file, or not a match.
    """
    try:
        return MatchConfig.model_validate_json(path.read_bytes())
    except OSError as error:
        raise TouchlineError(f"--config {path}: {error.strerror}; give the path of a match in JSON") from None
    except ValueError as error:
        raise TouchlineError(f"--config {path}: not a match: {str(error).splitlines()[0]}") from None
