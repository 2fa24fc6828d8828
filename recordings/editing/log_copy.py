"""Copies a part of MCAP files of any writer: each message keeps its payload, times and sequence number."""

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from mcap.reader import make_reader

from recordings.container.chunks import BROKEN
from recordings.container.environment import library
from recordings.container.key_selection import KeySelection
from recordings.container.mcap_writer import mcap_writer
from recordings.container.parts import NotWritableError
from recordings.reading.log_order import check_no_match, open_log, seconds_ns
from recordings.recorder.key_counts import KEYS, counts_of
from runtime.process.whole_file import written_whole
from schemas.errors import TouchlineError


def copy_log(
    paths: Sequence[Path], out: Path, selection: KeySelection, start: float | None = None, end: float | None = None
) -> int:
    """Copy the selected topics of all files, from `start` up to but not including `end`, in s since the first message.

    Returns the number of messages in the copy, which has metadata and attachments of all files, too, and the counts of
    recorders of keys together.

    Raises:
        TouchlineError: no message is selected, a file is damaged inside, or the copy cannot be written.
    """
    log = open_log(paths, selection.key_of)
    check_no_match(log)
    stop_ns = seconds_ns(end) if end is not None else None
    copied = 0
    try:
        with written_whole(out) as draft, draft.open("wb") as file:
            mcap = mcap_writer(file)
            mcap.start(profile=_profile(log.files[0].path), library=library())
            schema_of = cache(mcap.register_schema)
            channels: dict[int, int] = {}
            for message in log.messages(seconds_ns(start or 0.0)):
                if stop_ns is not None and message.log_ns >= stop_ns:
                    break
                channel = message.topic
                if (number := channels.get(id(channel))) is None:
                    known = channel.schema
                    schema = schema_of(known.name, known.encoding, known.data) if known is not None else 0
                    number = mcap.register_channel(channel.key, channel.encoding, schema, channel.metadata)
                    channels[id(channel)] = number
                log_ns = message.log_ns + log.base_ns
                mcap.add_message(number, log_ns, message.payload, message.sent_ns, message.sequence)
                copied += 1
            if not copied:
                raise TouchlineError(f"{paths[0]}: has no message in this time; it lasts {log.end_ns / 1e9:.2f} s")
            mcap.flush()  # type: ignore[no-untyped-call]
            for source in log.files:
                for name, content in source.attachments.items():
                    mcap.add_attachment(0, 0, name, "application/octet-stream", content)
                for name, metadata in source.metadata.items():
                    if name != KEYS:
                        mcap.add_metadata(name, metadata)
            if (counts := counts_of(log.files)) is not None:
                mcap.add_metadata(KEYS, counts.metadata())
            mcap.finish()  # type: ignore[no-untyped-call]
    except OSError as error:
        raise NotWritableError(out, error.strerror or str(error)) from None
    return copied


def _profile(path: Path) -> str:
    """The profile of a file, `ros2` of a bag."""
    with path.open("rb") as file:
        try:
            return str(make_reader(file).get_header().profile)
        except BROKEN:
            return ""
