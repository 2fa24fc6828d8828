"""Encodings of payloads, as MCAP and Zenoh name them."""

from recordings.container.mcap_file import ChannelRecord

_TYPES = {name: f"application/{name}" for name in ("json", "cdr", "protobuf", "cbor", "msgpack")}
_NAMES = {kind: name for name, kind in _TYPES.items()}
_RAW = "application/octet-stream"
ENCODING = "zenoh_encoding"
"""Key in the metadata of a channel: the encoding as Zenoh named it."""


def zenoh_encoding(channel: ChannelRecord) -> str:
    """Zenoh's encoding of a channel's messages, with the name of their schema."""
    if ENCODING in channel.metadata:
        return channel.metadata[ENCODING]
    kind = _TYPES.get(channel.encoding, _RAW)
    return f"{kind};{channel.schema_name}" if channel.schema_name else kind


def mcap_encoding(encoding: str) -> tuple[str, str]:
    """MCAP's encoding of messages with this encoding of Zenoh, and the name of their schema; empty without one."""
    kind, _, schema = encoding.partition(";")
    return _NAMES.get(kind, kind), schema
