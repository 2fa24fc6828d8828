"""Writes an MCAP file of other messages than the bus's own: its schemas and encodings are the caller's."""

from pathlib import Path
from types import TracebackType
from typing import Self

from recordings.container.mcap_writer import mcap_writer


class TypedWriter:
    """One file; use it as a context. Whoever writes sees to it that `OSError` becomes a sentence."""

    def __init__(self, path: Path, library: str) -> None:
        self._file = path.open("wb")
        self._mcap = mcap_writer(self._file)
        self._mcap.start(profile="", library=library)
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Finish the file; after an error it is closed as it is."""
        if kind is None:
            self._mcap.finish()  # type: ignore[no-untyped-call]
        self._file.close()

    def metadata(self, name: str, fields: dict[str, str]) -> None:
        """Write a metadata record."""
        self._mcap.add_metadata(name, fields)

    def attach(self, name: str, content: bytes) -> None:
        """Attach a text."""
        self._mcap.add_attachment(0, 0, name, "text/plain", content)

    def schema(self, name: str, full_name: str, encoding: str, content: bytes) -> None:
        """Make a schema known, to be named by `channel`."""
        self._schemas[name] = self._mcap.register_schema(full_name, encoding, content)

    def channel(self, key: str, schema: str, encoding: str, metadata: dict[str, str]) -> None:
        """Make a key known, to be named by `message`."""
        self._channels[key] = self._mcap.register_channel(key, encoding, self._schemas[schema], metadata)

    def message(self, key: str, payload: bytes, log_ns: int, sent_ns: int, sequence: int) -> None:
        """Write a message."""
        self._mcap.add_message(self._channels[key], log_ns, payload, sent_ns, sequence)
