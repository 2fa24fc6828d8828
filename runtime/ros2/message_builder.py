"""Builds and encodes the usual messages of ROS, by rosbags' store of types."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from runtime.ros2.message_types import typestore
from runtime.ros2.topic_type import ODOMETRY, TWIST, TopicType

_EXACT = np.zeros(36)
"""Covariance of exactly known values."""


class MessageBuilder:
    """Builds messages from numbers in SI units."""

    def __init__(self) -> None:
        """Read the types.

        Raises:
            TouchlineError: rosbags is not installed.
        """
        self._store = typestore()
        self._types = self._store.types

    def make(self, name: str, *fields: Any) -> Any:
        """A message of this type, with the fields in the order of its definition."""
        return self._types[name](*fields)

    def filled(self, name: str, fields: Mapping[str, Any]) -> Any:
        """A message of this type with these fields; the others are zero, false or empty."""
        wanted = self._store.fielddefs[name][1]
        return self.make(name, *(fields[one] if one in fields else self._empty(kind) for one, kind in wanted))

    def _empty(self, description: Any) -> Any:
        """The value of an empty field; of sequences and arrays only those occur that are no numbers."""
        from rosbags.interfaces import Nodetype

        kind, detail = description
        if kind == Nodetype.NAME:
            return self.filled(detail, {})
        if kind == Nodetype.BASE:
            return {"string": "", "bool": False}.get(detail[0], 0)
        return []

    def encode(self, message: Any, topic_type: TopicType) -> memoryview:
        """The message in CDR."""
        encoded: memoryview = self._store.serialize_cdr(message, topic_type.message)
        return encoded

    def stamp(self, ns: int) -> Any:
        """A time in ns since the start, or since 1970."""
        return self.make("builtin_interfaces/msg/Time", *divmod(ns, 1_000_000_000))

    def header(self, stamp: Any, frame: str) -> Any:
        """The header of a message in this frame."""
        return self.make("std_msgs/msg/Header", stamp, frame)

    def transform(self, stamp: Any, parent: str, child: str, x: float, y: float, z: float, heading: float) -> Any:
        """Where a frame is in another."""
        transform = self.make("geometry_msgs/msg/Transform", self.vector(x, y, z), self.quaternion(heading))
        return self.make("geometry_msgs/msg/TransformStamped", self.header(stamp, parent), child, transform)

    def odometry(self, header: Any, child: str, pose: Any, twist: Any) -> Any:
        """Pose in the frame of the header, twist in the frame `child`."""
        return self.make(
            ODOMETRY.message,
            header,
            child,
            self.make("geometry_msgs/msg/PoseWithCovariance", pose, _EXACT),
            self.make("geometry_msgs/msg/TwistWithCovariance", twist, _EXACT),
        )

    def twist(self, vx: float, vy: float, vz: float, omega: float) -> Any:
        """A velocity, and a turn rate about z."""
        return self.make(TWIST.message, self.vector(vx, vy, vz), self.vector(0.0, 0.0, omega))

    def vector(self, x: float, y: float, z: float) -> Any:
        """A vector."""
        return self.make("geometry_msgs/msg/Vector3", x, y, z)

    def pose(self, x: float, y: float, z: float, heading: float) -> Any:
        """A place with a turn about z."""
        return self.make("geometry_msgs/msg/Pose", self.point(x, y, z), self.quaternion(heading))

    def point(self, x: float, y: float, z: float) -> Any:
        """A place."""
        return self.make("geometry_msgs/msg/Point", x, y, z)

    def quaternion(self, heading: float) -> Any:
        """A turn about z."""
        return self.make("geometry_msgs/msg/Quaternion", 0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2))
