"""Facts of MCAP files of any writer: their channels, counts, rates, encodings, schemas and times."""

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from recordings.inspection.recording_facts import CUT_OFF
from recordings.reading.log_order import open_log
from recordings.recorder.key_counts import counts_of, was_cut_off

HEADINGS = ("topic", "encoding", "schema", "messages", "per s", "lost")
"""Column headings for `channel_rows`."""


@dataclass(frozen=True, slots=True)
class ChannelFacts:
    """Facts of one topic with one encoding."""

    topic: str
    encoding: str
    schema: str
    """Name of the schema; empty without one."""
    schema_encoding: str
    messages: int
    start: float
    """Time of the first message, in s since the first of all."""
    end: float
    lost: int | None
    """Messages that did not reach a recorder of keys; None if none has counted to its end."""

    @property
    def rate(self) -> float:
        """Messages per s of log time."""
        return (self.messages - 1) / (self.end - self.start) if self.end > self.start else 0.0


@dataclass(frozen=True, slots=True)
class LogFacts:
    """Facts of one or several files."""

    files: list[str]
    complete: bool
    """Whether their writers finished all files."""
    started: str
    """Log time of the first message, ISO 8601, UTC."""
    duration: float
    """Log time from the first to the last message, in s."""
    messages: int
    lost: int | None
    """Messages on all keys that did not reach a recorder of keys; None if none has counted to its end."""
    unwritten: int
    """Messages that had arrived at the end of a recorder of keys, and for which there was no time."""
    ended: str | None
    """`cut_off` if a recorder of keys was not ended, but killed; else None."""
    size: int
    """Bytes of all files."""
    attachments: list[str]
    metadata: list[str]
    """Names of the records."""
    channels: list[ChannelFacts]


def log_facts(paths: Sequence[Path]) -> LogFacts:
    """The facts of files and bag folders.

    Raises:
        TouchlineError: a file cannot be read, is not MCAP, or there is no message.
    """
    log = open_log(paths)
    counts = counts_of(log.files)
    channels = []
    for key, one in log.merged_channels():
        start, end = (max(0.0, (ns - log.base_ns) / 1e9) for ns in (one.first_ns, one.last_ns))
        language = one.schema.encoding if one.schema is not None else ""
        lost = counts.lost.get(key, 0) if counts is not None else None
        channels.append(ChannelFacts(key, one.encoding, one.schema_name, language, one.messages, start, end, lost))
    return LogFacts(
        files=[str(file.path) for file in log.files],
        complete=all(file.complete for file in log.files),
        started=datetime.fromtimestamp(log.base_ns / 1e9, UTC).isoformat(timespec="milliseconds"),
        duration=log.end_ns / 1e9,
        messages=sum(one.messages for one in channels),
        lost=sum(counts.lost.values()) if counts is not None else None,
        unwritten=counts.unwritten if counts is not None else 0,
        ended=CUT_OFF if any(was_cut_off(file) for file in log.files) else None,
        size=sum(file.size for file in log.files),
        attachments=sorted({name for file in log.files for name in file.attachments}),
        metadata=sorted({name for file in log.files for name in file.metadata}),
        channels=channels,
    )


def channel_rows(facts: LogFacts) -> list[tuple[str, ...]]:
    """One row for each channel, with the columns `HEADINGS`."""
    return [
        (one.topic, one.encoding, one.schema, str(one.messages), f"{one.rate:.1f}", _text(one.lost))
        for one in facts.channels
    ]


def _text(count: int | None) -> str:
    return "" if count is None else str(count)


def log_lines(facts: LogFacts) -> list[tuple[str, str]]:
    """Name and value of each fact."""
    values = {
        "started": facts.started,
        "duration": f"{facts.duration:.3f} s",
        "messages": f"{facts.messages}"
        + (f", {facts.lost} lost" if facts.lost is not None else "")
        + (f", {facts.unwritten} unwritten at the end" if facts.unwritten else ""),
        "ended": f"{facts.ended}: its recorder did not end it, and the losses are not known" if facts.ended else "",
        "files": str(len(facts.files)) if len(facts.files) > 1 else "",
        "attachments": " ".join(facts.attachments),
        "metadata": " ".join(facts.metadata),
        "size": f"{facts.size} bytes" + ("" if facts.complete else ", cut off"),
    }
    return [(name, value) for name, value in values.items() if value]
