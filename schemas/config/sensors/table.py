"""The table of sensors: a new kind is a file and a row here, and a row in `sim_host.sensing.sensors.table`."""

from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.contact import Bumper, ContactReading
from schemas.config.sensors.kinds import KINDS, Reading, Sensor, SensorKind
from schemas.config.sensors.range import RangeFinder, RangeReading

KINDS |= {
    "range": SensorKind(RangeFinder, RangeReading),
    "compass": SensorKind(Compass, CompassReading),
    "contact": SensorKind(Bumper, ContactReading),
}

__all__ = ["KINDS", "Reading", "Sensor", "SensorKind"]
