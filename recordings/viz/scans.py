"""Readings of range finders as `foxglove.LaserScan`, each in the frame of its robot."""

import math
from collections.abc import Callable, Iterator, Mapping

from foxglove_schemas_protobuf.LaserScan_pb2 import LaserScan

from recordings.viz.drawn_world import DrawnWorld
from recordings.viz.foxglove import set_time
from recordings.viz.primitives import pose
from schemas.config.sensors.range import RangeReading
from schemas.config.sensors.table import Sensor
from schemas.frames import base
from schemas.wire.part import convert

SCANS = "/viz/range"
"""Each sensor has a topic of its own below it: viewers keep the newest message of a topic."""


def scans(
    world: DrawnWorld, log_ns: int, sensors_of: Callable[[str], Mapping[str, Sensor]]
) -> Iterator[tuple[str, bytes]]:
    """Topic and message of each scan in a world; `sensors_of` gives the sensors of a robot."""
    for robot, readings in world.sensors.items():
        for name, content in readings.items():
            sensor = sensors_of(robot).get(name)
            if content.get("kind") == "range" and sensor is not None and robot in world.robots:
                x, y, height = sensor.mount
                mount = x, y, height - world.robots[robot].z
                yield f"{SCANS}/{robot}/{name}", _scan(convert(content, RangeReading), base(robot), mount, log_ns)


def _scan(reading: RangeReading, frame: str, mount: tuple[float, float, float], log_ns: int) -> bytes:
    """A scan of a sensor at `mount` in its robot's frame; a beam without a return is infinite."""
    scan = LaserScan(
        frame_id=frame,
        pose=pose(mount),
        start_angle=reading.angle_min,
        end_angle=reading.angle_min + (len(reading.distances) - 1) * reading.angle_increment,
        ranges=[math.inf if one is None else one for one in reading.distances],
    )
    set_time(scan.timestamp, log_ns)
    return scan.SerializeToString()
