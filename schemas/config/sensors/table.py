"""The table of sensors: a new kind is a file and a row here, and a row in `sim_host.sensing.sensors.table`."""

from schemas.config.sensors.compass import Compass, CompassReading
from schemas.config.sensors.contact import Contact, ContactReading
from schemas.config.sensors.kinds import KINDS, Reading, Sensor, SensorKind
from schemas.config.sensors.range import Range, RangeReading

KINDS |= {
    "range": SensorKind(Range, RangeReading),
    "compass": SensorKind(Compass, CompassReading),
    "contact": SensorKind(Contact, ContactReading),
}

__all__ = ["KINDS", "Reading", "Sensor", "SensorKind"]
