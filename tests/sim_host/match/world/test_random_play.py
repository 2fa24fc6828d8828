"""Random play of ten robots: for all inputs, the world stays within its walls, its bodies and its energy.

An example is a start, a drive and a way to dribble for each robot, and a list of errands for each. Errands look at the
world, so that robots meet ball, posts, walls and each other far more often than blind commands would let them.
`TOUCHLINE_RANDOM_PLAYS=2000 python -m pytest -o timeout=0 tests/sim_host/match/world` plays as many, and other ones.
"""

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from random import Random
from typing import NamedTuple

import pybullet
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from schemas.config.profile import Profile, load_profile
from schemas.config.quantity import Choice, meanings
from schemas.config.robot_model import RobotModel
from schemas.config.rolling import GRAVITY
from schemas.config.roster import Placement
from schemas.config.sections import Dribble
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from schemas.side import Side
from sim_host.match.world import World
from sim_host.physics.engine import Engine
from sim_host.snapshot import RobotState, Roster, Snapshot
from sim_host.soccer.ball.carrying import PULL_SPEED
from sim_host.soccer.game import ARENA

NAMES = tuple(f"{side.value}{number}" for side in Side for number in range(1, 6))
SIDES = tuple(side for side in Side for _ in range(5))
MOTIONS = ("velocity", "traction", "omni", "mixed")
METHODS = {name: meaning for name, meaning in meanings(Dribble).items() if isinstance(meaning, Choice)}[
    "method"
].options
PROFILES = {name: load_profile(name) for name in ("msl", "paper")}
LONGER = int(os.environ.get("TOUCHLINE_RANDOM_PLAYS", "0"))
DEEP = 0.02
"""m; how far two bodies may be in each other."""
TOUCHING = 0.001
"""m of air between two robots that count as touching."""
ERRAND_TICKS = 40
PLAYS, MORE_PLAYS = 4, 12
FASTEST_KICK = 40.0
"""m/s that a command may ask for."""
LEFT = 0.9
"""Share of what a ball is in a body that the engine leaves of it in a step."""
RECENT = 2
"""Ticks in which the engine takes the ball out of the hull of who carried it."""


class Errand(NamedTuple):
    """What a robot does for a while."""

    name: str
    to: int
    """Of the places, or the other robots."""
    vx: float
    vy: float
    omega: float
    dribble: bool
    kick: KickMode
    speed: float


class Play(NamedTuple):
    """One example."""

    profile: str
    motion: str
    methods: tuple[str, ...]
    start: str
    ball: tuple[float, float, float]
    errands: list[list[Errand]]


def drawn(random: Random) -> Play:
    """A play by lot."""
    return Play(
        profile=random.choice(list(PROFILES)),
        motion=random.choice(MOTIONS),
        methods=tuple(random.choice(METHODS) for _ in NAMES),
        start=random.choice(("centre", "goal", "corner", "apart")),
        ball=(random.uniform(-12, 12), random.uniform(-12, 12), random.uniform(-2, 8)),
        errands=[[an_errand(random) for _ in NAMES] for _ in range(4)],
    )


def an_errand(random: Random) -> Errand:
    return Errand(
        name=random.choice(("ball", "ball", "ball", "ram", "place", "blind", "rest")),
        to=random.randrange(10),
        vx=random.uniform(-20, 20),
        vy=random.uniform(-20, 20),
        omega=random.uniform(-50, 50),
        dribble=random.random() < 0.5,
        kick=random.choice(list(KickMode)),
        speed=random.uniform(0.1, 40),
    )


class NotingEngine(Engine):
    """Notes what happens in each physics step: two robots may meet and part within a tick."""

    def __init__(self, profile: Profile, roster: Roster) -> None:
        self.carried: set[str] = set()
        """Robots that have carried the ball since this was last cleared."""
        self.met: set[str] = set()
        """Robots that have touched another robot or the ball since this was last cleared."""
        self._carrier: str | None = None
        super().__init__(profile, roster)

    def ignore_ball_contacts(self, robot: int | None) -> None:
        self._carrier = None if robot is None else NAMES[robot]
        super().ignore_ball_contacts(robot)

    def step(self) -> None:
        if self._carrier is not None:
            self.carried.add(self._carrier)
        super().step()
        for one, other, depth in contacts(self):
            if depth >= -TOUCHING and one in NAMES and other in NAMES:
                self.met.update((one, other))
        self.met.update(NAMES[place] for place in self.ball_contacts(None).forces)


@dataclass
class Watched:
    """A world and what is known of it."""

    play: Play
    profile: Profile
    roster: Roster
    engine: NotingEngine
    world: World

    @classmethod
    def begin(cls, play: Play) -> "Watched":
        profile = PROFILES[play.profile]
        roster = Roster(NAMES, SIDES, {side: f"{side.value}1" for side in Side}, tuple(models(play, profile)))
        engine = NotingEngine(profile, roster)
        watched = cls(play, profile, roster, engine, World(profile, roster, ARENA, engine))
        watched.world.place(watched.starts())
        engine.set_ball_motion(play.ball, (0.0, 0.0, 0.0))
        return watched

    def starts(self) -> list[Placement]:
        """Ten robots around a spot, in two rings with room between them, or all over the pitch."""
        field = self.profile.field
        apart = 2 * max(model.body.reach for model in self.roster.models) + 0.05
        x, y = {
            "centre": (0.0, 0.0),
            "goal": (field.goal_line - 2.2 * apart, 0.0),
            "corner": (field.goal_line - 1.5 * apart, field.touch_line - 1.5 * apart),
            "apart": (0.0, 0.0),
        }[self.play.start]
        wide = 5.0 if self.play.start == "apart" else 1.0
        placements = [Placement(body="ball", x=x, y=y)]
        for place, name in enumerate(NAMES):
            ring, number = divmod(place, 5)
            angle = 2 * math.pi * (number + ring / 2) / 5
            away = wide * apart * (1 + 0.75 * ring)
            px, py = x + away * math.cos(angle), y + away * math.sin(angle)
            placements.append(Placement(body=name, x=px, y=py, heading=angle + math.pi))
        return placements

    def told(self, errand: Errand, place: int, snapshot: Snapshot) -> AppliedInput:
        """What an errand makes a robot do now."""
        me, holds = snapshot.robots[place], snapshot.possession == NAMES[place]
        kick = Kick(mode=errand.kick, speed=errand.speed) if holds and abs(errand.omega) < 30 else None
        if errand.name == "blind":
            drive = Drive(vx=errand.vx, vy=errand.vy, omega=errand.omega)
        elif errand.name == "rest":
            drive = Drive()
        else:
            x, y = self.target(errand, snapshot)
            away = math.remainder(math.atan2(y - me.y, x - me.x) - me.heading, 2 * math.pi)
            drive = Drive(vx=12 * math.cos(away), vy=12 * math.sin(away), omega=max(-50, min(50, 8 * away)))
        return AppliedInput(drive, errand.dribble or errand.name == "ball", kick)

    def target(self, errand: Errand, snapshot: Snapshot) -> tuple[float, float]:
        """Where an errand leads: the ball, another robot, or a place with a post, a wall or a net."""
        if errand.name == "ball":
            return snapshot.ball.x, snapshot.ball.y
        if errand.name == "ram":
            other = snapshot.robots[errand.to]
            return other.x, other.y
        field = self.profile.field
        sign, post = (-1) ** errand.to, field.goal_width / 2 + field.post / 2
        return [
            (sign * field.goal_line, post),
            (sign * (field.goal_line + 5), -post - 0.1),
            (sign * (field.goal_line + 5), 0.0),
            (sign * 20, 12.0),
            (0.0, sign * 20),
        ][errand.to // 2]


def models(play: Play, profile: Profile) -> Iterator[RobotModel]:
    """A wide keeper on either side, the others standard; each with its drive and its way to dribble."""
    wide = load_profile("msl")
    for place, method in enumerate(play.methods):
        is_keeper = place % 5 == 0 and play.profile == "msl"
        model = RobotModel.of_type(wide, "keeper") if is_keeper else RobotModel.standard(profile)
        motion = play.motion if play.motion != "mixed" else ("velocity", "omni", "traction")[place % 3]
        drive, dribble = replace(model.drive, model=motion), replace(model.dribble, method=method)
        yield replace(model, drive=drive, dribble=dribble)


def numbers(snapshot: Snapshot) -> Iterator[float]:
    """All there are in the world."""
    for robot in snapshot.robots:
        yield from robot[:-1]
    yield from snapshot.ball


def contacts(engine: Engine) -> Iterator[tuple[str, str, float]]:
    """Pairs of bodies that touch, by name, and how deep they are in each other, m."""
    names = dict(zip(engine.robots, NAMES, strict=True)) | {engine.ball: "ball"}
    names |= dict.fromkeys(engine.fixed_bodies(), "wall")
    for contact in pybullet.getContactPoints(physicsClientId=engine.client):
        yield names.get(contact[1], "ground"), names.get(contact[2], "ground"), -contact[8]


def robot_energy(state: RobotState, model: RobotModel) -> float:
    """Kinetic, J."""
    return (model.body.mass * (state.vx**2 + state.vy**2) + model.body.inertia_zz * state.omega**2) / 2


def ball_energy(engine: Engine, profile: Profile) -> float:
    """Kinetic, rotational and potential, J."""
    ball = profile.ball
    position, _ = pybullet.getBasePositionAndOrientation(engine.ball, physicsClientId=engine.client)
    velocity, spin = pybullet.getBaseVelocity(engine.ball, physicsClientId=engine.client)
    moving, turning = sum(v * v for v in velocity), sum(w * w for w in spin)
    return ball.mass * (moving / 2 + GRAVITY * position[2]) + ball.inertia * turning / 2


class Watch:
    """Looks at every tick of a play; what must never be is an assertion with its numbers."""

    def __init__(self, watched: Watched) -> None:
        self.engine, self.profile, self.roster = watched.engine, watched.profile, watched.roster
        self.step, self.tick = self.profile.time.physics_step, self.profile.time.tick
        self.before = watched.world.snapshot()
        self.energy = self._energies(self.before)
        self.fastest = 0.0
        """m/s of the ball in this tick."""
        self.flown = 0.0
        """m that a fast ball may still be in what it flew into: one step of flight, less what the engine took away."""
        self.held: list[set[str]] = [set()] * RECENT
        """Who has carried the ball, tick by tick."""

    def look(self, after: Snapshot) -> None:
        """Check one tick."""
        assert all(math.isfinite(number) for number in numbers(after))
        speeds = [math.hypot(*ball[3:]) for ball in (self.before.ball, after.ball)]
        if after.kicked is not None:
            speeds.append(self._kick_speed(after.kicked))
        self.fastest = max(speeds)
        self.flown = max(self.fastest * self.step, self.flown * LEFT**self.profile.time.steps_per_tick)
        self.held = [*self.held[1:], self.engine.carried.copy()]
        self._within_walls(after)
        self._not_in_each_other(after)
        self._energy(after)
        self.before = after
        self.engine.met.clear()
        self.engine.carried.clear()

    def _within_walls(self, after: Snapshot) -> None:
        field, ball = self.profile.field, self.profile.ball
        x, y = field.goal_line + field.border + DEEP, field.touch_line + field.border + DEEP
        for name, robot, model in zip(NAMES, after.robots, self.roster.models, strict=True):
            room = (x - model.body.radius - abs(robot.x), y - model.body.radius - abs(robot.y))
            assert min(room) >= 0, f"{name} left the field: {robot}"
            assert abs(robot.z - model.body.height / 2) < DEEP, f"{name} left the ground: {robot}"
        sunk = self.fastest * self.step
        room = (x - ball.radius - abs(after.ball.x), y - ball.radius - abs(after.ball.y), after.ball.z - ball.radius)
        assert min(room) >= -DEEP - sunk, f"the ball left the field: {after.ball}"

    def _not_in_each_other(self, after: Snapshot) -> None:
        """Two cm; the ball also as far as it flies in a step, and as a carried ball lies in its carrier's hull."""
        for one, other, depth in contacts(self.engine):
            allowed = DEEP
            if "ball" in (one, other):
                allowed += self.flown + max(map(self._in_hull, {one, other} & set().union(*self.held)), default=0.0)
            assert depth <= allowed, f"tick {after.tick}: {one} and {other} are {depth:.3f} m in each other"

    def _in_hull(self, name: str) -> float:
        """m by which the ball lies in the hull of a robot that carries it."""
        model = self.roster.models[NAMES.index(name)]
        return max(0.0, model.body.radius + self.profile.ball.radius - model.dribble.gap)

    def _energy(self, after: Snapshot) -> None:
        """Never more than drives, dribblers and kicks put in; and a ball without a touch only loses energy."""
        before, now = self.energy, self._energies(after)
        touched = after.touches or self.before.touches or after.kicked or after.possession or self.before.possession
        if not touched:
            brought_on = 2 * self.profile.ball.mass * GRAVITY * self.fastest * self.step  # at up to two impacts
            gain = now[-1] - before[-1]
            assert gain <= 1e-3 + brought_on, f"tick {after.tick}: the ball gains {gain} J"
        work = sum(
            self._work(robot, model, in_touch=name in self.engine.met)
            for name, robot, model in zip(NAMES, self.before.robots, self.roster.models, strict=True)
        )
        gained = sum(now) - sum(before)
        assert gained <= work + self._handed(after), f"tick {after.tick}: {gained} J out of nothing"
        self.energy = now

    def _energies(self, snapshot: Snapshot) -> list[float]:
        robots = [robot_energy(r, m) for r, m in zip(snapshot.robots, self.roster.models, strict=True)]
        return [*robots, ball_energy(self.engine, self.profile)]

    def _work(self, robot: RobotState, model: RobotModel, in_touch: bool) -> float:
        """What a drive can do in a tick: as much as its limits, or the grip of its wheels, change speed and turn.

        The drives `velocity` and `traction` set what they planned in each step, whatever is in the way, and so give
        as often all that this robot has lost to another, or to the ball: it has no measure of what it pushes.
        Who touches neither is given nothing again, and in `omni` nobody is.
        """
        body, drive, wheels = model.body, model.drive, model.wheels
        gain, turn_gain = max(drive.acceleration, drive.deceleration), drive.turn_acceleration
        if drive.model == "omni":
            gain = wheels.traction * GRAVITY
            turn_gain = gain * body.mass * wheels.arm / body.inertia_zz
        gain, turn_gain = gain * self.tick, turn_gain * self.tick
        if in_touch and drive.model != "omni":
            again = (self.profile.time.steps_per_tick - 1) * robot_energy(robot, model)
        else:
            again = 0.0
        moved = again + body.mass * (math.hypot(robot.vx, robot.vy) + gain / 2) * gain
        return moved + body.inertia_zz * (abs(robot.omega) + turn_gain / 2) * turn_gain

    def _kick_speed(self, name: str) -> float:
        kicker = self.roster.models[NAMES.index(name)].kicker
        return max(kicker.max_ground_speed, min(kicker.max_air_speed, FASTEST_KICK))

    def _handed(self, after: Snapshot) -> float:
        """What dribbler or kicker may give the ball in this tick: the speed it then has, rolling."""
        ball = self.profile.ball
        speed = 0.0
        for name in {after.possession, self.before.possession} - {None}:
            place = NAMES.index(str(name))
            robot, model = after.robots[place], self.roster.models[place]
            speed = max(
                speed, math.hypot(robot.vx, robot.vy) + abs(robot.omega) * model.dribble.distance + 2 * PULL_SPEED
            )
        if after.kicked is not None:
            speed = max(speed, self._kick_speed(after.kicked))
        return (ball.mass + ball.inertia / ball.radius**2) * speed**2 / 2


@pytest.mark.parametrize(
    "number", [*range(PLAYS), *(pytest.param(n, marks=pytest.mark.long) for n in range(PLAYS, MORE_PLAYS))]
)
def test_under_any_commands_of_ten_robots_the_world_keeps_its_invariants(number: int) -> None:
    """Nothing leaves the walls or explodes, no body sinks into another, and energy comes from drives and kicks alone.

    Robots stay upright, and the ball is carried through no body.
    """
    look_on(Random(number))


@pytest.mark.skipif(not LONGER, reason="TOUCHLINE_RANDOM_PLAYS is not set")
@settings(max_examples=LONGER or 1, database=None, derandomize=False, suppress_health_check=list(HealthCheck))
@given(st.randoms(use_true_random=False))
def test_under_any_other_commands_it_keeps_them_too(random: Random) -> None:
    look_on(random)


def look_on(random: Random) -> None:
    """Play by lot, and check each tick."""
    play = drawn(random)
    watched = Watched.begin(play)
    try:
        watch = Watch(watched)
        for errands_of_all in play.errands:
            for _ in range(ERRAND_TICKS):
                told = {
                    name: watched.told(errand, place, watch.before)
                    for place, (name, errand) in enumerate(zip(NAMES, errands_of_all, strict=True))
                }
                watch.look(watched.world.advance(told).snapshot)
    finally:
        watched.world.close()
