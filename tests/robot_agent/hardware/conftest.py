"""Guarded dummy hardware on a clock that is stepped."""

import pytest

from robot_agent.hardware.dummy import Dummy
from robot_agent.hardware.guard import HardwareGuard
from robot_agent.hardware.settings import HardwareSettings
from support.messages import make_setup
from support.stepped_clock import SteppedClock


class Bench:
    """One robot's hardware, its guard and the clock of both."""

    def __init__(self, armed=True, profile="msl", dummy=None, **settings):
        self.model = make_setup(profile).model_of("cyan2")
        self.clock = SteppedClock()
        self.hardware = dummy if dummy is not None else Dummy(self.model)
        chosen = HardwareSettings(hardware="dummy", **settings)
        self.guard = HardwareGuard(self.hardware, chosen, self.model, "cyan2", self.clock, armed=armed)

    def after(self, seconds):
        self.clock.sleep_until(self.clock.now() + seconds)


@pytest.fixture
def bench():
    return Bench
