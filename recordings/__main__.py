"""`python -m recordings`: records a match until its host leaves, or until it is told to stop."""

import argparse
import gc
import signal
import sys
import threading
from pathlib import Path

from recordings.container.key_selection import KeySelection
from recordings.recorder.record import read_config, record
from recordings.recorder.recorder import RecordingSummary
from recordings.recorder.sink import FileLimits
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.errors import TouchlineError
from schemas.process.scheduling import use_batch_scheduling

_GC_THRESHOLD = 100_000
"""Objects made until Python looks for garbage in cycles: messages come by the thousand, and are in none."""


def main(arguments: list[str] | None = None) -> int:
    """Record; the exit status is 0, or 2 when something has to be mended first."""
    options = _parser().parse_args(arguments)
    use_batch_scheduling()  # what has come waits for it; nobody else has to
    gc.freeze()
    gc.set_threshold(_GC_THRESHOLD)
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    try:
        summary = record(
            options.connect,
            options.match,
            options.out,
            name=options.name,
            sights=options.sights,
            selection=KeySelection(tuple(options.include), tuple(options.exclude)),
            limits=FileLimits(
                size=round(options.split_size * 1e6) if options.split_size is not None else None,
                duration=options.split_duration,
                keep=options.keep,
                snapshot=options.snapshot,
            ),
            config=read_config(options.config) if options.config is not None else None,
            viz=options.viz,
            patience=options.patience,
            should_stop=stop.is_set,
        )
    except TouchlineError as error:
        sys.stderr.write(f"touchline: {error}\n")
        return 2
    sys.stdout.write(_sentence(summary) + "\n")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m recordings", description=__doc__)
    parser.add_argument("--connect", default=DEFAULT_ENDPOINT, help="endpoint of the host (%(default)s)")
    parser.add_argument("--match", required=True, help="name of the match")
    parser.add_argument("--out", required=True, type=Path, help="the file, *.mcap")
    parser.add_argument("--name", default="recorder", help="what this recorder is called (%(default)s)")
    parser.add_argument("--sights", action="store_true", help="record too what the robots perceive")
    more, positive = "may be given several times", _positive
    parser.add_argument(
        "--include", action="append", default=[], help=f"record these keys alone, robot/*/command; {more}"
    )
    parser.add_argument("--exclude", action="append", default=[], help=f"leave these keys out; {more}")
    parser.add_argument("--split-size", type=positive, help="MB after which the next file is begun")
    parser.add_argument("--split-duration", type=positive, help="simulated s after which the next file is begun")
    parser.add_argument("--keep", type=_count, help="keep so many files, the newest")
    parser.add_argument("--snapshot", type=positive, help="simulated s before a goal that are written; nothing else is")
    parser.add_argument("--no-viz", dest="viz", action="store_false", help="leave out what viewers draw")
    parser.add_argument("--config", type=Path, help="the match as JSON, to be kept in the file")
    parser.add_argument("--patience", type=float, default=30.0, help="s to wait for the host (%(default)s)")
    return parser


def _positive(text: str) -> float:
    number = float(text)
    if not 0.0 < number < float("inf"):
        raise ValueError(text)
    return number


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


def _sentence(summary: RecordingSummary) -> str:
    result = summary.result
    files = f"{summary.files[0]}" + (f" and {len(summary.files) - 1} more" if summary.files[1:] else "")
    if not summary.files:
        return "nothing was to be kept"
    return (
        f"{files}: {result.messages} messages, {result.tick + 1} ticks, {result.lost} lost, "
        f"{summary.size} bytes, ended by {result.ended.value}"
    )


if __name__ == "__main__":
    raise SystemExit(main())
