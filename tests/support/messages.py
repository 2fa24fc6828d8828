"""Builders of messages: a setup, worlds, events and sights with what a test does not name filled in."""

from typing import Any

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.setup import Setup
from schemas.messages.sight import BallSight, Motion, Obstacle, ReceivedRadio, Sight
from schemas.messages.soccer.game import GameEvent, GameView
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind, TeamPhase

TICK = 0.02
"""s."""


def make_setup(profile: str = "msl", rules: str = "friendly", *, size: int | None = None, **match: Any) -> Setup:
    """The setup of a match of `size` a side, five if not given; `match` has values of the match file."""
    sizes = {} if size is None else {f"teams.{side}.size": size for side in Side}
    return Setup.of(load_match(None, {**sizes, **match}), load_profile(profile), load_rule_book(rules))


def make_robot(x: float = 0.0, y: float = 0.0, heading: float = 0.0, **more: Any) -> RobotTruth:
    """A robot that stands and does not hold the ball, unless `more` says otherwise."""
    content = {"x": x, "y": y, "z": 0.4, "heading": heading, "vx": 0.0, "vy": 0.0, "omega": 0.0, "holding": False}
    return RobotTruth(**{**content, **more})


def make_world(
    tick: int, ball: tuple[float, float] = (0.0, 0.0), robots: dict[str, RobotTruth] | None = None, **more: Any
) -> World:
    """A world whose ball lies."""
    x, y = ball
    truth = BallTruth(x=x, y=y, z=0.11, vx=0.0, vy=0.0, vz=0.0)
    return World(**{"tick": tick, "time": tick * TICK, "robots": robots or {}, "ball": truth, **more})


def make_event(tick: int, text: str = "text", kind: EventKind = EventKind.STOP, **more: Any) -> GameEvent:
    """An event of a tick."""
    content = {"tick": tick, "time": tick * TICK, "clock": 0.0, "kind": kind, "rule": "rule", "text": text}
    return GameEvent(**{**content, **more})


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
        time=tick * TICK,
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
            clock=tick * TICK,
            our_score=0,
            their_score=0,
            spot=spot,
            **more.pop("game", {}),
        ),
        **more,
    )
