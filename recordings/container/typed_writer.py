"""Writes an MCAP file with schemas and encodings chosen by the caller."""

from pathlib import Path
from types import TracebackType
from typing import Self

from recordings.container.mcap_writer import mcap_writer


class TypedWriter:
    """One file, used as a context manager. Methods may raise `OSError`."""

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
        """Finish the file; after an error, close it as it is."""
        if kind is None:
            self._mcap.finish()  # type: ignore[no-untyped-call]
        self._file.close()

    def metadata(self, name: str, fields: dict[str, str]) -> None:
        """Write a metadata record."""
        self._mcap.add_metadata(name, fields)

    def attach(self, name: str, content: bytes) -> None:
        """Attach a text file."""
        self._mcap.add_attachment(0, 0, name, "text/plain", content)

    def schema(self, name: str, full_name: str, encoding: str, content: bytes) -> None:
        """Register a schema for `channel`."""
        self._schemas[name] = self._mcap.register_schema(full_name, encoding, content)

    def channel(self, key: str, schema: str, encoding: str, metadata: dict[str, str]) -> None:
        """Register a key for `message`."""
        self._channels[key] = self._mcap.register_channel(key, encoding, self._schemas[schema], metadata)

    def message(self, key: str, payload: bytes, log_ns: int, sent_ns: int, sequence: int) -> None:
        """Write a message."""
        self._mcap.add_message(self._channels[key], log_ns, payload, sent_ns, sequence)
