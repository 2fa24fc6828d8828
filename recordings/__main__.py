"""`python -m recordings`: records a match until its host leaves, or until it is told to stop."""

import argparse
import signal
import sys
import threading
from pathlib import Path

from recordings.record import read_config, record
from recordings.recorder import RecordingSummary
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.errors import TouchlineError


def main(arguments: list[str] | None = None) -> int:
    """Record; the exit status is 0, or 2 when something has to be mended first."""
    options = _parser().parse_args(arguments)
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
            config=read_config(options.config) if options.config is not None else None,
            patience=options.patience,
            told_to_stop=stop.is_set,
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
    parser.add_argument("--config", type=Path, help="the match as JSON, to be kept in the file")
    parser.add_argument("--patience", type=float, default=30.0, help="s to wait for the host (%(default)s)")
    return parser


def _sentence(summary: RecordingSummary) -> str:
    result = summary.result
    return (
        f"{summary.path}: {result.messages} messages, {result.tick + 1} ticks, {result.lost} lost, "
        f"{summary.size} bytes, ended by {result.ended.value}"
    )


if __name__ == "__main__":
    raise SystemExit(main())
