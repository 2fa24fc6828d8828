"""Keys, liveliness tokens, identities and attachments of a ROS 2 graph over Zenoh, as rmw_zenoh writes them. Pure.

Tokens are what `ros2 topic list` and `ros2 node list` show; a publisher without one is heard and not seen.
"""

import struct
from enum import StrEnum
from typing import NamedTuple

from runtime.process.installed import need
from runtime.ros2.topic_type import TopicType, ros_type

TOKENS = "@ros2_lv"
"""First chunk of every token."""
CONTROL = "touchline"
"""Namespace of the services by which nodes control a match."""
_ENCLAVE = "%"
"""The enclave of a node without security by sros2."""
_STAMP = struct.Struct("<qqB16s")
_GID_SIZE = 16
_MASK_64 = (1 << 64) - 1


class Kind(StrEnum):
    """What a token stands for."""

    NODE = "NN"
    PUBLISHER = "MP"
    SUBSCRIPTION = "MS"
    SERVICE = "SS"
    CLIENT = "SC"


class Attachment(NamedTuple):
    """What comes with every message, request and reply."""

    sequence: int
    """Counts the messages of a publisher, from 1."""
    sent_ns: int
    """Wall time, ns since 1970."""
    gid: bytes
    """Identity of the publisher or client, 16 bytes."""

    def pack(self) -> bytes:
        """The 33 bytes on the wire."""
        return _STAMP.pack(self.sequence, self.sent_ns, _GID_SIZE, self.gid)

    @classmethod
    def unpack(cls, raw: bytes) -> "Attachment | None":
        """The attachment in these bytes; None if they are none."""
        if len(raw) != _STAMP.size or raw[16] != _GID_SIZE:
            return None
        sequence, sent_ns, _, gid = _STAMP.unpack(raw)
        return cls(sequence, sent_ns, gid)


class NodeName(NamedTuple):
    """A node of a session."""

    domain: int
    session: str
    """Zenoh's id of the session."""
    number: int
    """Of the node, among all nodes and endpoints of the session."""
    name: str
    namespace: str = ""
    """Begins with a slash; empty for the root."""

    @property
    def token(self) -> str:
        """The liveliness token of the node."""
        return self._token(self.number, Kind.NODE)

    def endpoint_token(self, number: int, kind: Kind, topic: str, topic_type: TopicType, type_hash: str) -> str:
        """The liveliness token of one of its publishers, subscriptions, services or clients.

        Raises:
            TouchlineError: the quality of service is malformed.
        """
        parts = (self._token(number, kind), _mangled(topic), topic_type.dds, type_hash, topic_type.quality)
        return "/".join(parts)

    def _token(self, number: int, kind: Kind) -> str:
        place = f"{TOKENS}/{self.domain}/{self.session}/{self.number}/{number}/{kind}"
        return f"{place}/{_ENCLAVE}/{_mangled(self.namespace)}/{self.name}"


class Endpoint(NamedTuple):
    """A publisher, subscription, service or client of any node, as its token describes it."""

    token: str
    kind: Kind
    node: str
    """With its namespace: `/cyan/striker`."""
    topic: str
    """`/cyan1/cmd_vel`."""
    message: str
    """`geometry_msgs/msg/Twist`."""
    type_hash: str


def data_key(domain: int, topic: str, topic_type: TopicType, type_hash: str) -> str:
    """The key of a topic's messages, or of a service's requests."""
    return f"{domain}/{topic.strip('/')}/{topic_type.dds}/{type_hash}"


def tokens_of(domain: int, topic: str, kind: Kind) -> str:
    """Key expression of the tokens of a topic's endpoints, of whatever type."""
    return f"{TOKENS}/{domain}/*/*/*/{kind}/*/*/*/{_mangled(topic)}/**"


def endpoint_of(token: str) -> Endpoint | None:
    """What a token describes; None for one of a node, or of another form."""
    parts = token.split("/")
    if len(parts) < 13 or parts[0] != TOKENS or parts[5] not in set(Kind) - {Kind.NODE}:
        return None
    namespace = parts[7].replace("%", "/").rstrip("/")
    topic = parts[9].replace("%", "/")
    return Endpoint(token, Kind(parts[5]), f"{namespace}/{parts[8]}", topic, ros_type(parts[10]), parts[11])


def gid_of(token: str) -> bytes:
    """The identity of the endpoint with this token: XXH3-128, the low 64 bits first.

    Raises:
        TouchlineError: xxhash is not installed.
    """
    need("a ROS 2 graph requires xxhash, which is not installed", "ros2", "xxhash")
    import xxhash

    whole = xxhash.xxh3_128_intdigest(token.encode())
    return (whole & _MASK_64).to_bytes(8, "little") + (whole >> 64).to_bytes(8, "little")


def _mangled(name: str) -> str:
    """A name as one chunk of a token; `%` for an empty one."""
    return name.replace("/", "%") or "%"
