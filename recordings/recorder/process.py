"""The recorder process: one match from its endpoint into files, with the process's signals and garbage collection."""

import gc
import signal
import sys
import threading
from collections.abc import Callable

from recordings.recorder.key_recorder import record_keys
from recordings.recorder.record import record
from recordings.recorder.recording_summary import RecordingSummary
from recordings.recorder.settings import RecorderSettings
from runtime.process.large_blocks import return_large_blocks
from runtime.process.process_log import configure_log, log_line
from runtime.process.scheduling import use_batch_scheduling
from schemas.errors import TouchlineError

_GC_THRESHOLD = 100_000
"""New objects after which Python searches for reference cycles: messages are many, and are in no cycle."""


def run(settings: RecorderSettings) -> int:
    """Record until the host leaves, or until SIGINT or SIGTERM; returns the exit status, 1 without a recording.

    Raises:
        TouchlineError: no host answers, or the file cannot be written.
    """
    configure_log("recorder", settings.log_format)
    return_large_blocks()
    use_batch_scheduling()  # no process waits for the recorder
    gc.freeze()
    gc.set_threshold(_GC_THRESHOLD)
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    if settings.keys:
        return _record_keys(settings, stop.is_set)
    if settings.listen is not None:
        raise TouchlineError("--listen needs --keys, such as --keys 'robot/**'; a match is recorded at its --connect")
    summary = record(settings, stop.is_set, log_line)
    if summary is None:
        log_line("stopped before there was a host; nothing is recorded")
        return 1
    result = summary.result
    log_line(closing_line(summary), stream=sys.stdout, messages=result.messages, lost=result.lost, size=summary.size)
    return 0


def _record_keys(settings: RecorderSettings, should_stop: Callable[[], bool]) -> int:
    """Record any keys; returns the exit status, 1 if there was no network before the end."""
    keys = record_keys(settings, should_stop, log_line)
    if keys is None:
        log_line("stopped before there was a network; nothing is recorded")
        return 1
    if not keys.messages:
        log_line("nothing arrived on --keys; a match's host shows its topics only, such as touchline/friendly/world")
    log_line(keys.line(), stream=sys.stdout, messages=keys.messages, lost=keys.lost, size=keys.size)
    return 0


def closing_line(summary: RecordingSummary) -> str:
    """Files, counts and the reason of the end, for the terminal."""
    result = summary.result
    files = f"{summary.files[0]}" + (f" and {len(summary.files) - 1} more" if summary.files[1:] else "")
    return (
        f"{files}: {result.messages} messages, {result.tick + 1} ticks, {result.lost} lost, "
        f"{summary.size} bytes, ended by {result.ended.value}"
    )
