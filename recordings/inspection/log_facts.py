"""Facts of MCAP files of any writer: their channels, counts, rates, encodings, schemas and times."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from recordings.container.mcap_file import McapFile
from recordings.reading.log_order import open_log
from recordings.recorder.key_recorder import KEYS
from schemas.natural_order import natural_order

HEADINGS = ("topic", "encoding", "schema", "messages", "per s", "lost")
"""Column headings for `channel_rows`."""


@dataclass(slots=True)
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
    lost: int
    """Messages that did not reach a recorder of keys; 0 in files of others."""

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
    lost: int
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
    found: dict[tuple[str, str, str], ChannelFacts] = {}
    losses = [_losses(file) for file in log.files]
    for _, channel in log.channels:
        name, language = (channel.schema.name, channel.schema.encoding) if channel.schema is not None else ("", "")
        key = channel.key, channel.encoding, name
        start, end = ((ns - log.base_ns) / 1e9 for ns in (channel.first_ns, channel.last_ns))
        known = found.get(key)
        if known is None:
            lost = sum(one.get(channel.key, 0) for one in losses)
            found[key] = ChannelFacts(
                channel.key, channel.encoding, name, language, channel.messages, max(0.0, start), max(0.0, end), lost
            )
        elif channel.messages:
            known.messages += channel.messages
            known.start, known.end = min(known.start, start), max(known.end, end)
    channels = sorted(found.values(), key=lambda one: natural_order(one.topic))
    return LogFacts(
        files=[str(file.path) for file in log.files],
        complete=all(file.complete for file in log.files),
        started=datetime.fromtimestamp(log.base_ns / 1e9, UTC).isoformat(timespec="milliseconds"),
        duration=log.end_ns / 1e9,
        messages=sum(one.messages for one in channels),
        lost=sum(sum(one.values()) for one in losses),
        size=sum(file.size for file in log.files),
        attachments=sorted({name for file in log.files for name in file.attachments}),
        metadata=sorted({name for file in log.files for name in file.metadata}),
        channels=channels,
    )


def _losses(file: McapFile) -> dict[str, int]:
    """Key → messages lost, as a recorder of keys has counted them."""
    try:
        return {str(key): int(lost) for key, lost in json.loads(file.metadata.get(KEYS, {}).get("lost", "{}")).items()}
    except (ValueError, TypeError, AttributeError):
        return {}  # another writer uses this name


def channel_rows(facts: LogFacts) -> list[tuple[str, ...]]:
    """One row for each channel, with the columns `HEADINGS`."""
    return [
        (one.topic, one.encoding, one.schema, str(one.messages), f"{one.rate:.1f}", str(one.lost))
        for one in facts.channels
    ]


def log_lines(facts: LogFacts) -> list[tuple[str, str]]:
    """Name and value of each fact."""
    values = {
        "started": facts.started,
        "duration": f"{facts.duration:.3f} s",
        "messages": f"{facts.messages}, {facts.lost} lost",
        "files": str(len(facts.files)) if len(facts.files) > 1 else "",
        "attachments": " ".join(facts.attachments),
        "metadata": " ".join(facts.metadata),
        "size": f"{facts.size} bytes" + ("" if facts.complete else ", cut off"),
    }
    return [(name, value) for name, value in values.items() if value]
