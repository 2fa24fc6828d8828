"""Older versions of the protocol: what was renamed since, and their recorded messages as messages of this version.

On the bus a message of another major version is refused. A recording may be of any version in `READABLE`: its bytes
stay as they are in the file, and each message is converted when it is read or replayed.
"""

from typing import NamedTuple

from pydantic_core import from_json

from schemas.wire.message import VERSION
from schemas.wire.struct import encode

MAJOR = VERSION.split(".")[0]
READABLE = ("1", MAJOR)
"""Major versions whose recordings can be read."""


class Renaming(NamedTuple):
    """A topic or a field that has another name since a version."""

    since: str
    """The version that brought the new name."""
    before: str
    """The old name: the key of a topic, or a field as `Message.field`."""
    after: str
    """The new name, in the same form."""


RENAMINGS = (
    Renaming("2.0", "robot/{robot}/hand", "robot/{robot}/manual"),
    Renaming("2.0", "host/minutes", "host/record_batch"),
    Renaming("2.0", "ParametersRequest.deed", "ParametersRequest.operation"),
    Renaming("2.0", "Parameter.says", "Parameter.description"),
    Renaming("2.0", "Parameter.words", "Parameter.options"),
    Renaming("2.0", "Parameter.why_not", "Parameter.fixed_reason"),
    Renaming("2.0", "SceneRequest.deed", "SceneRequest.operation"),
    Renaming("2.0", "Scene.says", "Scene.description"),
    Renaming("2.0", "ReplayRequest.deed", "ReplayRequest.operation"),
)
"""Everything that was renamed; no topic that is recorded, and no field of a message on one."""


def is_readable(version: str) -> bool:
    """Whether recordings of this version of the protocol can be read."""
    return _major(version) in READABLE


def converted(payload: bytes, version: str) -> bytes:
    """A payload from a recording of that version, as a payload of this version; unchanged where the major is the same.

    A payload that is no message of a readable version is returned as it is: its decoder names the fault.
    """
    if _major(version) == MAJOR:
        return payload
    try:
        fields = from_json(payload)
    except ValueError:
        return payload
    if not isinstance(fields, dict) or not is_readable(str(fields.get("version", version))):
        return payload
    return encode(fields | {"version": VERSION})


def _major(version: str) -> str:
    return version.split(".")[0]
