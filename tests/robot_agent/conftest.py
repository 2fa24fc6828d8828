"""A setup, briefings and sights to try brains on."""

import math
from collections.abc import Callable

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.contract import Briefing
from schemas.frames import rotate, wrap
from schemas.messages.command import Drive
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from support.messages import make_setup, make_sight


@pytest.fixture(scope="session")
def setup() -> Setup:
    return make_setup()


@pytest.fixture(scope="session")
def paper_setup() -> Setup:
    return make_setup("paper", "paper")


@pytest.fixture
def briefing(setup: Setup) -> Briefing:
    return Briefing.of("cyan2", setup)


@pytest.fixture(scope="session")
def sight_of() -> Callable[..., Sight]:
    return make_sight


class Plant:
    """An ideal drive: the velocity goes straight to the demand at the limits; heading and position follow."""

    def __init__(self, limits: DriveLimits, body: Body) -> None:
        self.limits = limits
        self.body = body

    def step(self, demand: Drive) -> Body:
        """One tick under a demand."""
        me, lim = self.body, self.limits
        vx, vy = rotate(demand.vx, demand.vy, me.heading)
        dvx, dvy = vx - me.vx, vy - me.vy
        slows = math.hypot(vx, vy) < math.hypot(me.vx, me.vy)
        most = (lim.deceleration if slows else lim.acceleration) * lim.tick
        share = min(1.0, most / max(math.hypot(dvx, dvy), 1e-12))
        turn = max(-lim.turn_acceleration * lim.tick, min(lim.turn_acceleration * lim.tick, demand.omega - me.omega))
        vx, vy, omega = me.vx + share * dvx, me.vy + share * dvy, me.omega + turn
        self.body = Body(me.x + vx * lim.tick, me.y + vy * lim.tick, wrap(me.heading + omega * lim.tick), vx, vy, omega)
        return self.body


@pytest.fixture
def plant(limits: DriveLimits) -> Callable[..., Plant]:
    return lambda *body: Plant(limits, Body(*body))


@pytest.fixture(scope="session")
def limits(setup: Setup) -> DriveLimits:
    return DriveLimits.of(setup)
