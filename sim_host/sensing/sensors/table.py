"""The table of sensors on the host: a new kind is a file and a row here and in `schemas.config.sensors.table`."""

from sim_host.sensing.sensors.carried import ComputedSensor
from sim_host.sensing.sensors.compass import ComputedCompass
from sim_host.sensing.sensors.contact import ComputedContact
from sim_host.sensing.sensors.range import ComputedRange

COMPUTED: dict[str, type[ComputedSensor]] = {
    "range": ComputedRange,
    "compass": ComputedCompass,
    "contact": ComputedContact,
}
"""Kind → what computes its readings."""
