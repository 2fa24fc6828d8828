"""The type of a topic or service and its quality of service, as rmw_zenoh and rosbag2 write them. Pure."""

import re
from typing import NamedTuple

from schemas.errors import TouchlineError

DEFAULT_DEPTH = 42
"""The depth that rmw_zenoh leaves out."""
_QUALITY = re.compile(r"2?:1?:,([1-9]\d{0,9})?:,:,:,,")


class TopicType(NamedTuple):
    """Message type and quality of service of a topic; history is always `keep last`."""

    message: str
    """`geometry_msgs/msg/Twist`; of a service, `std_srvs/srv/SetBool`."""
    reliable: bool = True
    depth: int = 10
    latched: bool = False
    """Durability `transient local`: whoever subscribes later gets the newest `depth` messages as well."""
    version: str = ""
    """Folder of the package with the fields of older releases; empty for the newest one."""

    @property
    def dds(self) -> str:
        """The name in keys: `geometry_msgs::msg::dds_::Twist_`."""
        package, kind, name = self.message.split("/")
        return f"{package}::{kind}::dds_::{name}_"

    @property
    def quality(self) -> str:
        """The quality of service in a liveliness token; what has its default value is left out.

        Raises:
            TouchlineError: it is malformed; every node of the domain would report errors.
        """
        depth = "" if self.depth == DEFAULT_DEPTH else self.depth
        text = f"{'' if self.reliable else 2}:{1 if self.latched else ''}:,{depth}:,:,:,,"
        if _QUALITY.fullmatch(text) is None:
            raise TouchlineError(f"{self.message}: the depth of a queue is {self.depth}; it is a positive number")
        return text


def ros_type(dds: str) -> str:
    """The type with this name in keys; the name itself if it is none of ROS."""
    found = re.fullmatch(r"(\w+)::(msg|srv|action)::dds_::(\w+)_", dds)
    return "/".join(found.groups()) if found else dds


CLOCK = TopicType("rosgraph_msgs/msg/Clock", False, 1)
TF = TopicType("tf2_msgs/msg/TFMessage", True, 100)
TF_STATIC = TopicType("tf2_msgs/msg/TFMessage", True, 1, latched=True)
ODOMETRY = TopicType("nav_msgs/msg/Odometry")
SCAN = TopicType("sensor_msgs/msg/LaserScan", False, 5)
TWIST = TopicType("geometry_msgs/msg/Twist")
TWIST_STAMPED = TopicType("geometry_msgs/msg/TwistStamped")
POSE = TopicType("geometry_msgs/msg/PoseStamped")
POINT = TopicType("geometry_msgs/msg/PointStamped")
FLAG = TopicType("std_msgs/msg/Bool")
NUMBER = TopicType("std_msgs/msg/Int32")
VALUE = TopicType("std_msgs/msg/Float64")
TEXT = TopicType("std_msgs/msg/String", True, 100)
DIAGNOSTICS = TopicType("diagnostic_msgs/msg/DiagnosticArray")
BALL = TopicType("touchline_msgs/msg/Ball")
OBSTACLES = TopicType("touchline_msgs/msg/Obstacles")
GAME = TopicType("touchline_msgs/msg/Game")
KICK = TopicType("touchline_msgs/srv/Kick")
"""As offered by the usual publishers of these topics: the clock and scans best effort, the others reliable."""
