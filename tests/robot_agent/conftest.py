"""A setup, briefings and sights to try brains on."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from robot_agent.bodies import Body, DriveLimits
from robot_agent.contract import Briefing
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.frames import from_body, wrap
from schemas.game import TeamPhase
from schemas.messages.command import Drive
from schemas.messages.game import GameView
from schemas.messages.setup import Setup
from schemas.messages.sight import BallSight, Motion, Obstacle, ReceivedRadio, Sight
from schemas.side import Side


def setup_of(profile_name: str = "msl", rules_name: str = "friendly") -> Setup:
    return Setup.of(MatchConfig(), load_profile(profile_name), load_rule_book(rules_name))


@pytest.fixture(scope="session")
def setup() -> Setup:
    return setup_of()


@pytest.fixture(scope="session")
def paper_setup() -> Setup:
    return setup_of("paper", "paper")


@pytest.fixture
def briefing(setup: Setup) -> Briefing:
    return Briefing.of("cyan2", setup)


@pytest.fixture(scope="session")
def sight_of() -> Callable[..., Sight]:
    return make_sight


def make_sight(
    tick: int = 0,
    robot: str = "cyan2",
    at: tuple[float, float, float] = (0.0, 0.0, 0.0),
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ball: tuple[float, ...] | BallSight | None = (3.0, 0.0),
    phase: TeamPhase = TeamPhase.PLAY,
    running: bool = True,
    spot: Any = None,
    obstacles: tuple[tuple[float, float], ...] = (),
    radio: dict[str, ReceivedRadio] | None = None,
    **more: Any,
) -> Sight:
    """A sight at tick `tick` of 20 ms; `ball` is x, y and perhaps vx, vy."""
    if isinstance(ball, tuple):
        x, y, vx, vy = (*ball, 0.0, 0.0)[:4]
        ball = BallSight(x=x, y=y, vx=vx, vy=vy)
    return Sight(
        tick=tick,
        time=tick * 0.02,
        robot=robot,
        side=Side.CYAN if robot.startswith("cyan") else Side.MAGENTA,
        self=Motion(x=at[0], y=at[1], heading=at[2], vx=velocity[0], vy=velocity[1], omega=velocity[2]),
        ball=ball,
        holding=more.pop("holding", False),
        obstacles=[Obstacle(x=x, y=y, radius=0.25) for x, y in obstacles],
        radio=radio or {},
        game=GameView(
            phase=phase,
            running=running,
            clock=tick * 0.02,
            our_score=0,
            their_score=0,
            spot=spot,
            **more.pop("game", {}),
        ),
        **more,
    )


class Plant:
    """An ideal drive: the velocity goes straight to the demand at the limits; heading and position follow."""

    def __init__(self, limits: DriveLimits, body: Body) -> None:
        self.limits = limits
        self.body = body

    def step(self, demand: Drive) -> Body:
        """One tick under a demand."""
        me, lim = self.body, self.limits
        vx, vy = from_body(demand.vx, demand.vy, me.heading)
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
