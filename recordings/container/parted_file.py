"""The parts of a recording, read as one file."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from mcap.records import Message

from recordings.container.manifest import DAMAGED_RECORDS, MANIFEST, RECOVERED, RESULT, Manifest
from recordings.container.mcap_file import END_NS, ChannelRecord, McapFile, open_mcap_file
from recordings.container.parts import parts_of
from recordings.container.sealed_metadata import from_metadata, is_sealed, sealed
from schemas.errors import TouchlineError


@dataclass(slots=True)
class PartedFile(McapFile):
    """The parts in their order. Each has the messages from where it begins up to where the next one begins."""

    files: list[McapFile] = field(default_factory=list)
    begins_ns: list[int] = field(default_factory=list)
    """Simulated time in ns at which each file begins; 0 for the first, all of which is read."""

    @property
    def size(self) -> int:
        """Bytes of all files."""
        return sum(file.size for file in self.files)

    def messages(self, keys: set[str], start_ns: int = 0, end_ns: int = END_NS) -> Iterator[tuple[str, Message]]:
        """Yield key and message, in order, from `start_ns` up to but not including `end_ns`.

        Raises:
            TouchlineError: a file is damaged.
        """
        for file, begin_ns, stop_ns in self._spans():
            yield from file.messages(keys, max(begin_ns, start_ns), min(stop_ns, end_ns))

    def add_channels(self) -> None:
        """Sum up the channels of the files, without messages that another file has."""
        found: dict[str, ChannelRecord] = {}
        for file, begin_ns, stop_ns in self._spans():
            keys = {channel.key for channel in file.channels.values()}
            others = ((0, begin_ns), (stop_ns, END_NS))
            elsewhere = Counter(
                key for first, end in others if first < end for key, _ in file.messages(keys, first, end)
            )
            for channel in file.channels.values():
                messages = channel.messages - elsewhere[channel.key]
                known = found.get(channel.key)
                if known is None:
                    found[channel.key] = replace(channel, messages=messages)
                elif messages:
                    known.messages += messages
                    known.last_ns = channel.last_ns
        self.channels = dict(enumerate(found.values(), start=1))

    def _spans(self) -> Iterator[tuple[McapFile, int, int]]:
        """Each file, with the times from which and up to which its messages count."""
        yield from zip(self.files, self.begins_ns, [*self.begins_ns[1:], END_NS], strict=True)


def open_parts(path: Path) -> McapFile:
    """The recording at this path: its file, or all of its parts.

    Raises:
        TouchlineError: a file cannot be read, or is a part of another recording.
    """
    found = [open_mcap_file(part) for part in parts_of(path) or [path]]
    # a recorder that was killed at once leaves a file without a manifest, and its successor has everything
    files = [file for file in found if MANIFEST in file.metadata] or found[:1]
    if len(files) == 1:
        return files[0]
    first, last = files[0], files[-1]
    manifests = [_manifest(file) for file in files]
    for file, manifest in zip(files, manifests, strict=True):
        if (manifest.match, manifest.host) != (manifests[0].match, manifests[0].host):
            raise TouchlineError(f"{file.path}: is a part of another recording than {path}; move it away")
    parted = PartedFile(path, last.complete, files=files)
    parted.attachments = {**last.attachments, **first.attachments}
    parted.begins_ns = [0, *(manifest.begins_ns for manifest in manifests[1:])]
    parted.metadata = {**first.metadata, **last.metadata, MANIFEST: first.metadata[MANIFEST]}
    if RESULT not in last.metadata:
        parted.metadata.pop(RESULT, None)
    damaged = sum(int(file.metadata.get(RECOVERED, {}).get(DAMAGED_RECORDS, "0")) for file in files)
    if damaged:
        parted.metadata[RECOVERED] = sealed({DAMAGED_RECORDS: str(damaged)})
    parted.add_channels()
    return parted


def _manifest(file: McapFile) -> Manifest:
    metadata = file.metadata[MANIFEST]
    if not is_sealed(metadata):
        raise TouchlineError(f"{file.path}: its manifest is damaged; use another copy of it")
    return from_metadata(Manifest, metadata)
