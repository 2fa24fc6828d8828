"""`touchline ros2`: a match as a ROS 2 graph."""

import os
import sys

from robot_agent.ros2.process import run
from robot_agent.ros2.settings import Ros2Settings
from touchline.commands.cli.option_groups import with_option_groups


@with_option_groups
def ros2(settings: Ros2Settings) -> None:
    """Show a running match or a replay as a ROS 2 graph, or let ROS 2 nodes drive its robots; needs no ROS here.

    The nodes use rmw_zenoh. In lockstep the match waits for their commands, and they run as fast as they can:
    docs/ros2.md.

    Example: touchline ros2 --side cyan
    """
    status = run(settings)
    sys.stderr.flush()
    os._exit(status)  # threads of robots and of Zenoh that return into an interpreter which ends would abort it
