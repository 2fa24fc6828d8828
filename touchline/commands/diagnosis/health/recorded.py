"""The ledger of a recorded match, from the reports of its host."""

from pathlib import Path

from recordings.reading.recording import open_recording
from schemas.errors import TouchlineError
from schemas.topics import HEALTH
from touchline.commands.diagnosis.health.ledger import Ledger, ledger_of


def ledger_of_recording(path: Path, start: float | None, end: float | None) -> Ledger:
    """The ledger of a recording from `start` to `end`, both in simulated s; by default of the whole recording.

    A stretch reaches from the last report at `start` or before it, to the last one before `end`.

    Raises:
        TouchlineError: the file is no recording, or has no report of the host in this stretch.
    """
    recording = open_recording(path)
    first = last = None
    for _, health in recording.decoded(HEALTH.key):
        if end is not None and health.time >= end:
            break
        if start is not None and health.time <= start:
            first = health
        else:
            last = health
    if last is None:
        parts = [f"after {start:g} s" if start is not None else "", f"before {end:g} s" if end is not None else ""]
        stretch = " and ".join(filter(None, parts))
        remedy = "reports come four times a second of wall time; choose a longer stretch"
        if not stretch:
            stretch, remedy = "is in it", f"record the key {HEALTH.key}, too"
        raise TouchlineError(f"{path}: no report of the host's health {stretch}; {remedy}")
    setup = recording.manifest.setup
    return ledger_of(last, setup.sides if setup is not None else {}, first)
