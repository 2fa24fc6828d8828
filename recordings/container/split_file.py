"""The numbered files of a split recording, read as one file."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import reduce
from itertools import islice
from pathlib import Path

from mcap.records import Message

from recordings.container.manifest import MANIFEST, RESULT, KeyCount, Manifest, Result
from recordings.container.mcap_file import ChannelRecord, McapFile, open_mcap_file
from recordings.container.numbering import numbered_files
from recordings.container.sealed_metadata import from_metadata, is_sealed, to_metadata
from schemas.errors import TouchlineError
from schemas.natural_order import natural_order

_Id = tuple[str, int, int]
"""Key, sequence number and time of sending of a message."""


@dataclass(slots=True)
class SplitFile(McapFile):
    """The files in their order; latched messages that a file repeats from the file before it are left out."""

    files: list[McapFile] = field(default_factory=list)
    _repeated: list[Counter[_Id]] = field(default_factory=list)

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(file.size for file in self.files)

    def messages(
        self, keys: set[str], start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[tuple[str, Message]]:
        """Yield key and message, in order, from `start_ns` up to but not including `end_ns`.

        Raises:
            TouchlineError: a file is damaged.
        """
        for file, repeated in zip(self.files, self._repeated, strict=True):
            left_out = Counter(repeated)
            for key, message in file.messages(keys, start_ns, end_ns):
                one = (key, message.sequence, message.publish_time)
                if left_out[one]:
                    left_out[one] -= 1
                else:
                    yield key, message


def open_split_file(path: Path) -> SplitFile | None:
    """The files of the split recording of this name; None if there are none.

    Raises:
        TouchlineError: a file cannot be read.
    """
    files = [open_mcap_file(file) for file in numbered_files(path)]
    if not files:
        return None
    first, last = files[0], files[-1]
    split = SplitFile(path, all(file.complete for file in files), first.library, files=files)
    split.attachments = first.attachments
    split.metadata = dict(first.metadata)
    split.metadata.pop(RESULT, None)
    channels: dict[str, ChannelRecord] = {}
    for number, file in enumerate(files):
        repeated = _repeats(file) if number else Counter()
        split._repeated.append(repeated)
        for channel in file.channels.values():
            _add_channel(channels, channel, sum(count for one, count in repeated.items() if one[0] == channel.key))
    split.channels = dict(enumerate(channels.values(), start=1))
    results = [_result(file) for file in files if is_sealed(file.metadata.get(RESULT, {}))]
    if last.complete and len(results) == len(files):
        split.metadata[RESULT] = to_metadata(results[-1].counted(_summed(results)))
    return split


def _repeats(file: McapFile) -> Counter[_Id]:
    """The messages at the beginning of a file that are in the files before it."""
    metadata = file.metadata.get(MANIFEST, {})
    if not is_sealed(metadata):
        raise TouchlineError(f"{file.path}: its manifest is damaged or missing; use another copy of it")
    latched_count = from_metadata(Manifest, metadata).latched_count
    keys = {channel.key for channel in file.channels.values() if channel.encoding == "json"}
    return Counter((key, one.sequence, one.publish_time) for key, one in islice(file.messages(keys), latched_count))


def _add_channel(channels: dict[str, ChannelRecord], channel: ChannelRecord, repeated: int) -> None:
    """Add a file's channel, of whose messages the first are `repeated`."""
    known = channels.get(channel.key)
    if known is None:
        known = channels[channel.key] = ChannelRecord(
            channel.key, channel.metadata, channel.encoding, channel.schema, 0, channel.first_ns, channel.last_ns
        )
    new = channel.messages - repeated
    if new > 0:
        known.last_ns = max(known.last_ns, channel.last_ns) if known.messages else channel.last_ns
        known.messages += new


def _result(file: McapFile) -> Result:
    return from_metadata(Result, file.metadata[RESULT])


def _summed(results: list[Result]) -> dict[str, KeyCount]:
    """Key → its counts in all files."""
    keys = sorted({key for result in results for key in result.keys}, key=natural_order)
    return {key: reduce(KeyCount.plus, (result.keys.get(key, KeyCount()) for result in results)) for key in keys}
