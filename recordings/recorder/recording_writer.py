"""Writes a recording as MCAP in zstd chunks, in a thread, so that compression and the disk do not delay the recorder.

The file can be read up to the last flush at any time.
"""

import os
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from queue import Empty, Queue
from threading import Thread

from recordings.container.attachments import MEDIA_TYPES
from recordings.container.environment import library
from recordings.container.json_schema import flat_schema
from recordings.container.manifest import MANIFEST, MANIFEST_COPY, RESULT, Manifest, Result
from recordings.container.mcap_file import ROW
from recordings.container.mcap_writer import mcap_writer
from recordings.container.parts import NotWritableError, create_part
from recordings.container.sealed_metadata import digest, to_metadata
from recordings.recorder.roster_metadata import RosterMetadata
from recordings.timing import FLUSH_S, RECOVERY_POLL_S
from recordings.viz.drawing import READS
from recordings.viz.viz_channels import VizChannels
from runtime.bus.contract import ReceivedMessage
from runtime.process.clock import Clock
from runtime.process.idle_time import run_in_idle_time, start_thread
from schemas.topics import TOPICS, key_prefix
from schemas.wire.message import VERSION
from schemas.wire.part import encode

LoggedMessage = tuple[int, ReceivedMessage]
"""Log time in ns, and message."""
_BACKLOG = 64
"""Batches that may wait for the thread; adding another one blocks."""

_SEQUENCES = 0xFFFF_FFFF
"""MCAP has sequence numbers of 32 bits."""


class RecordingWriter:
    """One file that is being written. Any method may raise `TouchlineError` if the disk cannot be written."""

    def __init__(self, path: Path, clock: Clock, *, viz: bool = True) -> None:
        """Create the file; with `viz`, the channels for viewers are written, too.

        Raises:
            TouchlineError: there is such a file already, or it cannot be written.
        """
        self.path = path
        self.size = 0
        """Bytes in the file so far, without messages that wait for the thread or for a full chunk."""
        self._clock = clock
        self._viz = viz
        self._viz_channels: VizChannels | None = None
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._jobs: Queue[Callable[[], None] | None] = Queue(_BACKLOG)
        self._error: Exception | None = None
        self._file = create_part(path)
        self._mcap = mcap_writer(self._file)
        self._thread = Thread(target=run_in_idle_time, args=[self._do_job], name="recording writer", daemon=True)
        self._flush_at = 0.0
        self._begun = False

    def begin(self, manifest: Manifest, attachments: dict[str, bytes], roster: RosterMetadata | None = None) -> None:
        """Write manifest and attachments, which have names with a suffix, `match.json`.

        `roster` describes the robots in keys; by default, that of the manifest.
        """
        self._begun = True
        self._root = key_prefix(manifest.match)
        self._roster = roster or RosterMetadata(manifest.setup)
        self._flush_at = self._clock.now() + FLUSH_S
        start_thread(self._thread)
        manifest = manifest.replace(attached={name: digest(content) for name, content in attachments.items()})
        if self._viz and manifest.setup is not None:
            self._viz_channels = VizChannels(self._mcap, manifest.setup)
        self._hand_over(partial(self._write_head, to_metadata(manifest), attachments))

    def write(self, batch: list[LoggedMessage]) -> None:
        """Add messages in the order of the file; blocks while the thread is far behind."""
        self._hand_over(partial(self._write_batch, batch))

    def sync(self) -> None:
        """Flush the messages so far to the disk soon, so that they survive a loss of power."""
        self._hand_over(self._sync)

    def finish(self, result: Result | None) -> None:
        """Write the result, if there is one, and close the file."""
        self._hand_over(partial(self._write_tail, to_metadata(result) if result is not None else None))
        self._end()
        self._raise_error()
        self._file.close()

    def abandon(self) -> None:
        """Close the file as it is, with all messages so far, or remove it if it was not begun.

        Has no effect after `finish`.
        """
        if self._thread.is_alive():
            self._jobs.put(self._sync)
            self._end()
        with suppress(OSError):  # an earlier error was raised
            if not self._begun:
                self.path.unlink(missing_ok=True)
            self._file.close()

    def _hand_over(self, job: Callable[[], None]) -> None:
        self._jobs.put(job)
        self._raise_error()

    def _end(self) -> None:
        self._jobs.put(None)
        self._thread.join()

    def _raise_error(self) -> None:
        if isinstance(self._error, OSError):
            reason = self._error.strerror or "cannot be written"
            raise NotWritableError(self.path, reason, "what was written before is readable")
        if self._error is not None:
            raise self._error

    def _do_job(self) -> bool:
        """Do the thread's next job, or a flush if that is due; returns whether the thread ends.

        After an error, jobs are discarded.
        """
        try:
            job = self._jobs.get(timeout=max(RECOVERY_POLL_S, self._flush_at - self._clock.now()))
        except Empty:
            job = _nothing
        if job is None or self._error is not None:
            return job is None
        try:
            job()
            self.size = self._file.tell()
            if self._clock.now() >= self._flush_at:
                self._mcap.flush()  # type: ignore[no-untyped-call]
                self._flush_at = self._clock.now() + FLUSH_S
        except Exception as error:  # raised again in the caller's thread
            self._error = error
        return False

    def _write_head(self, manifest: dict[str, str], attachments: dict[str, bytes]) -> None:
        self._mcap.start(profile="", library=library())
        self._mcap.add_metadata(MANIFEST, manifest)
        now = self._clock.unix_ns()
        for name, data in attachments.items():
            media = MEDIA_TYPES[Path(name).suffix]
            self._mcap.add_attachment(now, 0, name, media, data)
        self._mcap.add_metadata(MANIFEST_COPY, manifest)
        self._mcap.flush()  # type: ignore[no-untyped-call]

    def _write_batch(self, batch: list[LoggedMessage]) -> None:
        add, channels, viz_channels = self._mcap.add_message, self._channels, self._viz_channels
        for log_ns, received in batch:
            channel = channels.get(received.key) or self._open_channel(received)
            stamp = received.stamp
            if stamp is None:
                add(channel, log_ns, received.payload, received.arrived_ns or self._clock.unix_ns())
            else:
                add(channel, log_ns, received.payload, stamp.sent_ns, stamp.sequence & _SEQUENCES)
            if viz_channels is not None and received.topic.key in READS:
                viz_channels.draw(received, log_ns)

    def _open_channel(self, received: ReceivedMessage) -> int:
        topic, key = received.topic, received.key
        name = next(name for name, row in TOPICS.items() if row.key == topic.key)
        assert topic.message is not None
        metadata = {
            "key": self._root + key,
            "topic": name,
            ROW: topic.key,
            "message": topic.message.__name__,
            "version": VERSION,
            **self._roster.metadata_of(received.chunks),
        }
        schema = self._schema(received)
        channel = self._mcap.register_channel(key, "json", schema, metadata)
        self._channels[key] = channel
        return channel

    def _schema(self, received: ReceivedMessage) -> int:
        model = received.topic.message
        assert model is not None
        name = model.__name__
        if name not in self._schemas:
            data = encode(flat_schema(model, self._roster.robots))
            self._schemas[name] = self._mcap.register_schema(f"touchline.{name}", "jsonschema", data)
        return self._schemas[name]

    def _sync(self) -> None:
        self._mcap.flush()  # type: ignore[no-untyped-call]
        os.fsync(self._file.fileno())

    def _write_tail(self, result: dict[str, str] | None) -> None:
        self._mcap.flush()  # type: ignore[no-untyped-call]
        if result is not None:
            self._mcap.add_metadata(RESULT, result)
        self._mcap.finish()  # type: ignore[no-untyped-call]
        self._file.flush()
        os.fsync(self._file.fileno())


def _nothing() -> None:
    """Stands for a job when none arrived in time."""
