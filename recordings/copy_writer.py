"""Writes a recording that is made of messages of others, each as it was."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import Self

from recordings.container import ChannelRecord
from recordings.environment import library
from recordings.lean_writer import LeanWriter
from recordings.manifest import MANIFEST, RESULT, Manifest, Result, digest, to_metadata
from recordings.part import Part
from recordings.sequences import KeyLedger
from recordings.sketch import Sketch
from recordings.writer import CHUNK_BYTES, MEDIA_TYPES
from schemas.bus.contract import Received, Stamp
from schemas.errors import TouchlineError
from schemas.topics import TOPICS


class CopyWriter:
    """One file that is made of messages of others; leaves nothing when it is left before it is finished."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._part = Part(path)
        self._mcap = LeanWriter(self._part.file, CHUNK_BYTES)
        self._channels: dict[str, int] = {}
        self._schemas: dict[tuple[str, bytes], int] = {}
        self._ledgers: dict[str, KeyLedger] = {}
        self._messages = 0
        self._sketch: Sketch | None = None

    def begin(self, manifest: Manifest, attachments: dict[str, bytes], standing: int, *, viz: bool) -> None:
        """Write what stands before the first message; the first `standing` messages are such that stood then.

        With `viz`, what viewers draw is written, too.
        """
        if viz and manifest.setup is not None:
            self._sketch = Sketch(self._mcap, manifest.setup)
        attached = {name: digest(content) for name, content in attachments.items()}
        manifest = manifest.model_copy(update={"attached": attached, "standing": standing})
        with self._told():
            self._mcap.start(profile="", library=library())
            self._mcap.add_metadata(MANIFEST, to_metadata(manifest))
            for name, data in attachments.items():
                self._mcap.add_attachment(
                    0, 0, name, MEDIA_TYPES.get(Path(name).suffix, "application/octet-stream"), data
                )

    def add(
        self,
        channel: ChannelRecord,
        log_ns: int,
        payload: bytes,
        sent_ns: int,
        sequence: int,
        *,
        counted: bool = True,
    ) -> None:
        """Write a message as it was; one that is not `counted` is in the account of another file."""
        with self._told():
            number = self._channels.get(channel.key) or self._open_channel(channel)
            self._mcap.add_message(number, log_ns, payload, sent_ns, sequence)
            topic = TOPICS.get(channel.metadata.get("topic", ""))
            if self._sketch is not None and topic is not None:
                received = Received(topic, channel.key, payload, Stamp(sequence, sent_ns, log_ns))
                self._sketch.follow(received, log_ns)
        self._messages += 1
        if counted:
            ledger = self._ledgers.setdefault(channel.key, KeyLedger())
            ledger.enter(Stamp(sequence, sent_ns, log_ns), len(payload))

    def finish(self, result: Result | None) -> int:
        """Write the result with the counts of this file, give the file its name; returns how many messages it has."""
        with self._told():
            self._mcap.flush()  # type: ignore[no-untyped-call]
            if result is not None:
                counts = {key: ledger.count() for key, ledger in sorted(self._ledgers.items())}
                self._mcap.add_metadata(RESULT, to_metadata(result.counted(counts)))
            self._mcap.finish()  # type: ignore[no-untyped-call]
            self._part.file.flush()
            self._part.finish()
        return self._messages

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with suppress(OSError):
            self._part.discard()

    @contextmanager
    def _told(self) -> Iterator[None]:
        """What the disk refuses is said in one line."""
        try:
            yield
        except OSError as error:
            raise TouchlineError(f"{self._path}: {error.strerror}; make room, or give another path") from None

    def _open_channel(self, channel: ChannelRecord) -> int:
        number = 0
        if channel.schema is not None:
            schema = channel.schema
            known = self._schemas.get((schema.name, schema.data))
            number = known or self._mcap.register_schema(schema.name, schema.encoding, schema.data)
            self._schemas[schema.name, schema.data] = number
        opened = self._mcap.register_channel(channel.key, channel.encoding, number, channel.metadata)
        self._channels[channel.key] = opened
        return opened
