"""Recordings of matches: recorder, readers, editing, statistics, replay, other formats. Uses no physics."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from recordings.recorder.settings import RecorderSettings


def run(settings: "RecorderSettings") -> int:
    """Record a match until its host leaves, or until SIGINT or SIGTERM; the exit status of the process.

    Raises:
        TouchlineError: no host answers, or the file cannot be written.
    """
    from recordings.recorder.process import run as run_process

    return run_process(settings)
