"""The gate before hardware: a team plays seeded scenes alone, and is rejected where it would harm robots.

As in the Robotarium, bodies that touch and robots that leave the floor are errors; demands beyond a limit, which the
guard of hardware shortens, are counted.
"""

import math
import random
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import replace
from itertools import chain, combinations, product
from pathlib import Path
from statistics import quantiles
from typing import Any, NamedTuple

from robot_agent.process.timing import HANG_S
from runtime.process.clock import Clock, WallClock
from schemas.config.match_config import MatchConfig
from schemas.config.obstacle import ObstacleConfig
from schemas.config.profile import Profile
from schemas.config.robot_model import RobotModel, models_of
from schemas.config.scene import Scene, SceneBall, SceneRobot
from schemas.errors import TouchlineError
from sim_host.games import game_of_match
from sim_host.match.simulation import TickResult
from sim_host.staging.layout import obstacle_body
from sim_host.staging.overlap import Body, Disc, goal_blocks, overlap
from touchline.matches.engine.fresh_process import DiedProcessError, FreshProcesses
from touchline.matches.engine.hang_watch import HangWatch
from touchline.team.check.fresh_checks import died_sentence
from touchline.team.check.play import EndedEarlyError, play_checked
from touchline.team.check.subject import SIDE, BreachError, Subject

_TOUCH = 0.005
"""m between two hulls, or a hull and the boundary, from which on they touch."""
_ROOM = 0.5
"""m between the hulls of robots at the start of a scene."""
_TRIES = 1000
"""Places that are tried for one robot."""


class SceneResult(NamedTuple):
    """What became of a scene."""

    seed: int
    rejected: str
    """Why the team may not run, with the tick; empty where it may."""
    clearance: float | None
    """Smallest distance in m between two hulls, or a hull and the boundary; None where no tick was played."""
    clamped: int
    """Demands beyond a limit of the profile."""
    slowest_ms: float
    """99th percentile of the wall time of decisions, in ms."""


def pass_scenes(
    subject: Subject, scenes: int, seconds: float, clearance: float | None = None, hang_s: float = HANG_S
) -> Iterator[SceneResult]:
    """Play the scenes of the seeds from 1, a brain in a fresh process for each; arguments as of `pass_gate`.

    A brain that does not return for `hang_s` of wall time, or ends its process, is rejected.
    """
    if not subject.brain:
        yield from (pass_gate(subject, seed, seconds, WallClock(), clearance) for seed in range(1, scenes + 1))
        return
    processes = FreshProcesses(1)  # one at a time: its decisions are timed
    try:
        for seed in range(1, scenes + 1):
            try:
                yield processes.submit(_pass_watched, subject, seed, seconds, clearance, hang_s).result()
            except DiedProcessError as error:
                yield SceneResult(seed, died_sentence(error), None, 0, 0.0)
    finally:
        processes.shutdown(cancel_futures=True)


def _pass_watched(
    subject: Subject, seed: int, seconds: float, clearance: float | None, hang_s: float, note: Path
) -> SceneResult:
    with closing(HangWatch(note, hang_s, subject.config.patience.attendance)) as watch:
        return pass_gate(replace(subject, watch=watch), seed, seconds, WallClock(), clearance)


def pass_gate(subject: Subject, seed: int, seconds: float, clock: Clock, clearance: float | None = None) -> SceneResult:
    """Play the scene of a seed, with the filter for a clearance in m or without.

    Raises:
        TouchlineError: the floor has no room for the robots.
    """
    profile = subject.config.load_profile()
    scene = random_scene(subject.config, profile, seed)
    config = subject.config.model_copy(update={"scene": scene, "seed": seed})
    watch = _Watch(config, profile, scene.obstacles)
    try:
        played = play_checked(replace(subject, config=config), seconds, clock, watch.see, clearance)
    except BreachError as error:
        return SceneResult(seed, str(error), watch.clearance, 0, 0.0)
    rejected = watch.fault
    took = [1e3 * one.seconds for one in played.decisions if one.tick > 0]
    slowest, tick = quantiles(took, n=100)[98] if len(took) > 1 else 0.0, 1e3 * profile.time.tick
    if not rejected and (played.is_slow or slowest > tick):
        worst = max(played.decisions, key=lambda one: one.seconds)
        rejected = (
            f"tick {worst.tick}: {worst.robot} takes {1e3 * worst.seconds:.0f} ms to decide; one decision in a hundred "
            f"takes {slowest:.0f} ms or more, and a tick lasts {tick:.0f} ms"
        )
    return SceneResult(seed, rejected, watch.clearance, len(played.excesses), slowest)


def random_scene(config: MatchConfig, profile: Profile, seed: int) -> Scene:
    """The robots of the team at random places, apart from each other, with the obstacles of the match.

    Raises:
        TouchlineError: the floor has no room for the robots.
    """
    dice, pitch, models = random.Random(seed), profile.field, models_of(config, profile)
    given = config.scene
    obstacles = [*(given.obstacles if given is not None else config.obstacles)]
    taken = [obstacle_body(one, one.placement) for one in obstacles]
    robots = []
    for number, name in enumerate(config.robots(SIDE)):
        for _ in range(_TRIES):
            x, y = (dice.uniform(-0.45, 0.45) * side for side in (pitch.length, pitch.width))
            hull = _hull(name, x, y, models[name])
            if all(-overlap(hull, other) > _ROOM for other in taken):
                break
        else:
            raise TouchlineError(f"the floor has no room for {name}; name a match file with fewer robots or obstacles")
        taken.append(hull)
        keeper = number == 0 and len(config.robots(SIDE)) > 1
        heading = dice.uniform(-math.pi, math.pi)
        robots.append(SceneRobot(name=name, side=SIDE, x=x, y=y, heading=heading, keeper=keeper))
    ball = SceneBall(x=dice.uniform(-0.4, 0.4) * pitch.length, y=dice.uniform(-0.4, 0.4) * pitch.width)
    return Scene(description=f"Robots at random, seed {seed}.", robots=robots, ball=ball, obstacles=obstacles)


def _hull(name: str, x: float, y: float, model: RobotModel) -> Disc:
    return Disc(name, x, y, model.body.reach, 0.0, model.body.height)


class _Watch:
    """Looks at the bodies of each tick."""

    def __init__(self, config: MatchConfig, profile: Profile, obstacles: list[ObstacleConfig]) -> None:
        self._models = models_of(config, profile)
        self._fixed: list[Body] = [obstacle_body(one, one.placement) for one in obstacles]
        if game_of_match(config).arena.furniture.goals:
            self._fixed += goal_blocks(profile.field)
        self._half = profile.field.length / 2 + profile.field.border, profile.field.width / 2 + profile.field.border
        self.clearance: float | None = None
        self.fault = ""
        """The first fault, with its tick."""

    def see(self, result: TickResult) -> None:
        """Look at one tick.

        Raises:
            EndedEarlyError: bodies touch, or a robot is at the boundary.
        """
        robots: Mapping[str, Any] = result.world["robots"]
        hulls = [_hull(name, one["x"], one["y"], self._models[name]) for name, one in robots.items()]
        for hull, other in chain(combinations(hulls, 2), product(hulls, self._fixed)):
            self._note(result.tick, -overlap(hull, other), f"{hull.name} touches {other.name}")
        for hull in hulls:
            gap = min(half - abs(place) for half, place in zip(self._half, (hull.x, hull.y), strict=True))
            self._note(result.tick, gap - hull.radius, f"{hull.name} touches the boundary")

    def _note(self, tick: int, gap: float, fault: str) -> None:
        self.clearance = max(0.0, gap if self.clearance is None else min(self.clearance, gap))
        if gap < _TOUCH:
            self.fault = f"tick {tick}: {fault}"
            raise EndedEarlyError
