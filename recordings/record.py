"""Records a match from its endpoint into a file: what `touchline record` and `python -m recordings` do."""

from collections.abc import Callable
from pathlib import Path

from recordings.account import Account
from recordings.output import ONE_FILE, Files, Limits, Output
from recordings.recorder import Recorder, RecordingSummary
from recordings.selection import EVERYTHING, Selection
from recordings.snapshots import Snapshots
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.zenoh_bus import open_client
from schemas.clock import Clock, WallClock
from schemas.errors import TouchlineError
from schemas.match_config import MatchConfig


def record(
    connect: str = DEFAULT_ENDPOINT,
    match: str = "friendly",
    out: Path = Path("match.mcap"),
    *,
    name: str = "recorder",
    sights: bool = False,
    selection: Selection = EVERYTHING,
    limits: Limits = ONE_FILE,
    config: MatchConfig | None = None,
    viz: bool = True,
    patience: float = 30.0,
    told_to_stop: Callable[[], bool] = lambda: False,
) -> RecordingSummary:
    """Record until the host leaves or `told_to_stop` says so; `patience` is how long the host may take to appear, in s.

    With `viz`, what viewers draw is in the file beside the messages.

    Raises:
        TouchlineError: no host, or a file that cannot be written; what was written so far stays as `*.part`.
    """
    clock = WallClock()
    with open_client(match, clock, connect, patience) as bus:
        account = Account()
        output = output_at(out, clock, match, account, limits, viz=viz)
        try:
            recorder = Recorder(bus, output, account, name=name, sights=sights, selection=selection, config=config)
            return recorder.run(told_to_stop)
        finally:
            output.abandon()


def output_at(
    path: Path, clock: Clock, match: str, account: Account, limits: Limits = ONE_FILE, *, viz: bool = True
) -> Output:
    """Where a recording goes; with `viz`, what viewers draw is in it.

    Raises:
        TouchlineError: a file that cannot be written.
    """
    return (Files if limits.snapshot is None else Snapshots)(path, clock, match, account, limits, viz=viz)


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
