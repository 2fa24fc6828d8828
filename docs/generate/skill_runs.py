"""Runs of the skills for docs/team.md: in each, `cyan2` uses one skill in a match of this process, with default noise.

A run is a row of `RUNS`: where the bodies are, for how long, and the skill as a brain would call it.
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from robot_agent.sdk.skills.keep_out import Area
from schemas.config.match_config import load_match
from schemas.config.rolling import Rolling
from schemas.messages.command import Command, Drive, Kick
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.messages.world import World
from schemas.wire.part_faults import validated
from touchline import skills
from touchline.play.play_match import InProcessMatch

Place = tuple[float, float]
Decision = tuple[Drive, Kick | None]
GOAL = (11.0, 0.0)
"""m; the middle of the opponents' goal."""


class Scene(NamedTuple):
    """What a skill gets: the sight, with the bodies in it as plain numbers."""

    sight: Sight
    setup: Setup

    @property
    def limits(self) -> skills.DriveLimits:
        return skills.DriveLimits.of(self.setup)

    @property
    def ball(self) -> skills.Ball:
        """The ball as seen; the centre of the pitch before it is seen."""
        seen = self.sight.ball
        return skills.Ball(seen.x, seen.y, seen.vx, seen.vy) if seen is not None else skills.Ball(0.0, 0.0)

    @property
    def others(self) -> list[Place]:
        """Places of the other robots."""
        return [(other.x, other.y) for other in self.sight.obstacles]


Skill = Callable[[Scene], Decision]


def go_to(scene: Scene) -> Decision:
    return skills.go_to(scene.sight.self, 3.0, 1.5, math.pi / 2.0, scene.limits), None


def go_around(scene: Scene) -> Decision:
    blocked = skills.circles(scene.others, 2.0 * scene.setup.robot.reach + 0.1)
    return skills.go_around(scene.sight.self, 3.0, 0.0, 0.0, blocked, scene.limits), None


def circle(scene: Scene) -> Decision:
    return skills.circle(scene.sight.self, (0.0, 0.0), 1.5, scene.limits), None


def turn_to(scene: Scene) -> Decision:
    return skills.turn_to(scene.sight.self, math.pi, scene.limits), None


def take_ball(scene: Scene) -> Decision:
    gap, ball = scene.setup.dribble.gap, scene.ball
    meeting = skills.meet(scene.sight.self, skills.way_of(ball, Rolling.of(scene.setup.ball)), gap, scene.limits)
    clearance = 2.0 * scene.setup.robot.reach + 0.1
    return skills.take_ball(scene.sight.self, ball, meeting, gap, scene.others, clearance, scene.limits), None


def receive(scene: Scene) -> Decision:
    return skills.receive(scene.sight.self, scene.ball, scene.limits), None


def dribble_to(scene: Scene) -> Decision:
    blocked = skills.circles(scene.others, 2.0 * scene.setup.robot.reach + 0.2)
    return skills.dribble_to(scene.sight.self, 4.0, 0.0, 0.0, blocked, scene.limits), None


def kick_at(scene: Scene) -> Decision:
    return skills.kick_at(scene.sight.self, GOAL, 8.0, 0.2, scene.limits)


def best_place(scene: Scene) -> Decision:
    me = scene.sight.self
    aim, _width = skills.best_place((me.x, me.y), scene.others, scene.setup.pitch)
    return skills.kick_at(me, (GOAL[0], aim), 8.0, 0.2, scene.limits)


def pass_to(scene: Scene) -> Decision:
    return skills.pass_to(scene.sight.self, (3.0, 2.0), scene.setup, scene.limits)


def let_go(scene: Scene) -> Decision:
    kick = skills.let_go(scene.sight.self, scene.others, scene.setup) if scene.sight.time > 0.6 else None
    return skills.go_to(scene.sight.self, 6.0, 0.0, 0.0, scene.limits.capped(1.5)), kick


def keep_goal(scene: Scene) -> Decision:
    pitch, reach = scene.setup.pitch, scene.setup.robot.reach
    return skills.keep_goal(scene.sight.self, scene.ball, pitch, reach, scene.limits), None


def line_up(scene: Scene) -> Decision:
    ball = scene.ball
    return skills.line_up(scene.sight.self, (ball.x, ball.y), GOAL, 0.6, [], scene.limits), None


def stand(scene: Scene) -> Decision:
    sight, ball = scene.sight, scene.ball
    place = (ball.x - 1.0, ball.y)
    spot, me = (ball.x, ball.y), skills.Body(sight.self.x, sight.self.y, sight.self.heading)
    return skills.stand(me, place, sight.game, spot, scene.others, scene.setup, scene.limits), None


def keep_out(scene: Scene) -> Decision:
    wanted = skills.go_to(scene.sight.self, 10.6, 0.8, 0.0, scene.limits)
    return skills.keep_out(scene.sight.self, wanted, Area.goal(scene.setup.pitch), scene.limits), None


class Run(NamedTuple):
    """One run of a skill."""

    skill: Skill
    shown: tuple[float, float, float, float]
    """Part of the pitch in the picture: least and greatest x, least and greatest y, in m."""
    robot: tuple[float, float, float]
    """Pose of cyan2 at the start: x, y in m, heading in rad."""
    ball: tuple[float, float, float, float]
    """Place and velocity of the ball at the start: m, m/s."""
    seconds: float
    opponents: tuple[Place, ...] = ()
    """Where opponents stand still."""
    phase: str = "play"
    side: str | None = None


AWAY = (-9.0, 6.0, 0.0, 0.0)
"""A ball that is not in the picture."""
RUNS: Mapping[str, Run] = {
    "go_to": Run(go_to, (-4, 5, -2, 3), (-3.0, -1.0, 0.0), AWAY, 3.5),
    "go_around": Run(go_around, (-4, 5, -2.5, 2.5), (-3.0, 0.0, 0.0), AWAY, 3.5, ((-0.5, 0.1), (1.2, -0.4))),
    "circle": Run(circle, (-4, 4, -2.5, 2.5), (-3.0, 0.0, 0.0), AWAY, 5.0),
    "take_ball": Run(take_ball, (-4, 5, -2, 3), (-2.5, -1.0, 1.5), (4.0, 2.0, -2.5, -0.5), 2.6),
    "receive": Run(receive, (-4, 5, -2, 3), (-2.0, -0.5, 0.8), (4.5, 2.0, -4.0, -1.0), 1.9),
    "dribble_to": Run(dribble_to, (-2, 6, -2.5, 2.5), (-1.0, 0.0, 0.0), (-0.6, 0.0, 0.0, 0.0), 4.5, ((1.5, 0.1),)),
    "kick_at": Run(kick_at, (3, 12, -2.5, 2.5), (5.0, -1.0, 1.5), (5.0, -0.6, 0.0, 0.0), 1.9),
    "best_place": Run(best_place, (3, 12, -2.5, 2.5), (5.0, 0.0, 0.0), (5.4, 0.0, 0.0, 0.0), 2.0, ((9.5, -0.8),)),
    "pass_to": Run(pass_to, (-3, 5, -1.5, 3), (-2.0, 0.0, 0.0), (-1.6, 0.0, 0.0, 0.0), 1.6),
    "let_go": Run(let_go, (-2, 6, -2, 2), (-1.0, 0.0, 0.0), (-0.6, 0.0, 0.0, 0.0), 2.6),
    "keep_goal": Run(keep_goal, (-12, -3, -2.5, 2.5), (-10.6, 0.0, 0.0), (-4.5, -1.5, -6.0, 0.9), 0.98),
    "line_up": Run(line_up, (-3, 4, -2, 2), (2.5, 0.5, 3.0), (0.0, 0.0, 0.0, 0.0), 3.0),
    "stand": Run(
        stand, (-6, 3, -1.5, 4.0), (-0.8, 1.0, 0.0), (0.0, 0.0, 0.0, 0.0), 3.0, phase="free_kick", side="magenta"
    ),
    "keep_out": Run(keep_out, (5, 12, -2, 3), (6.0, 2.4, 0.0), AWAY, 3.0),
}
"""Skill → its run."""


class _Brain:
    """Asks one skill at each sight."""

    def __init__(self, skill: Skill, setup: Setup) -> None:
        self._skill, self._setup = skill, setup

    def act(self, sight: Sight) -> Command:
        drive, kick = self._skill(Scene(sight, self._setup))
        return Command(answers_tick=sight.tick, drive=drive, dribble=True, kick=kick if sight.holding else None)


def play(run: Run) -> tuple[Setup, list[World]]:
    """The setup, and the world at each tick of a run."""
    x, y, heading = run.robot
    ball = dict(zip(("x", "y", "vx", "vy"), run.ball, strict=True))
    robots = [{"name": "cyan2", "side": "cyan", "x": x, "y": y, "heading": heading}]
    robots += [
        {"name": f"magenta{number}", "side": "magenta", "x": x, "y": y, "heading": math.pi, "agent": False}
        for number, (x, y) in enumerate(run.opponents, 2)
    ]
    game = {"phase": run.phase} | ({"side": run.side} if run.side is not None else {})
    scene = {"description": "a run of one skill", "ball": ball, "game": game, "robots": robots}
    config = load_match(None, {"scene": scene, "referee.mode": "manual", "duration": 60.0})
    match = InProcessMatch(config, {"cyan2": _Still()})
    setup = match.simulation.setup()
    match.brains["cyan2"] = _Brain(run.skill, setup.for_robot("cyan2"))
    worlds = [validated(World, match.simulation.now.world)]
    while worlds[-1].time < run.seconds:
        worlds.append(validated(World, match.step().world))
    match.simulation.close()
    return setup, worlds


class _Still:
    """Rests."""

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)
