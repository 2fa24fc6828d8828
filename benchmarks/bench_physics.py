"""Physics steps per second with 2 to 100 robots and both motion models: the bare engine, the world, the whole tick.

Raw is the loop of any PyBullet program: set every robot's velocity, step, read all bodies. World adds everything that
turns commands into motion: possession, drives, wheels, the ball, contacts, the snapshot and the hash chain. Tick adds
the rest of a match: referee, sensing, radio, and one encoded sight for each robot. All robots drive circles, each in an
area of its own, so that the number of robots changes and not the number of collisions; one robot holds the ball.

The growth exponent p fits cost ~ n^p over all sizes (least squares of log cost over log n).

A tick of 100 robots should cost at most three times the raw physics of its steps with the profile `msl`.
"""

import math
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from rich.console import Console
from rich.table import Table

from schemas.config.profile import load_profile
from schemas.config.robot_model import RobotModel
from schemas.config.roster import Placement
from schemas.config.soccer.rule_book import load_rule_book
from schemas.frames import Pose
from schemas.messages.applied import AppliedInput
from schemas.messages.command import Drive
from schemas.side import Side
from sim_host.match.radio import RadioAir
from sim_host.match.sights import Sights
from sim_host.match.world import World
from sim_host.physics.engine import Engine
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.sensing.sensors.suite import SensorSuite
from sim_host.snapshot import Roster, Snapshot
from sim_host.soccer.game import ARENA
from sim_host.soccer.referee.core import Referee

SIZES = (2, 6, 10, 22, 100)
PROFILES = ("msl", "omni")
ROUNDS = 5
SECONDS_A_ROUND = 0.12
TICKS_A_ROUND = 256
"""Random numbers are drawn for as many ticks at once."""
MOST_TICK_COST = 3.0
"""Times raw, at the greatest size."""


@dataclass(frozen=True)
class Cost:
    """Medians in s: of a physics step raw and in the world, of sensing and of everything in a tick."""

    raw: float
    world: float
    sensing: float
    tick: float
    steps_per_tick: int

    @property
    def per_step(self) -> tuple[float, float, float]:
        """Raw, world and tick, each for one physics step."""
        return self.raw, self.world, self.tick / self.steps_per_tick


def roster_of(count: int, model: RobotModel) -> Roster:
    """A roster of `count` robots of one model, half of them on each side; may exceed the limit of a match file."""
    half = count // 2
    names = tuple(f"{side.value}{number}" for side in Side for number in range(1, half + 1))
    sides = tuple(side for side in Side for _ in range(half))
    return Roster(names, sides, {side: f"{side.value}1" for side in Side}, (model,) * len(names))


class TickRig:
    """Robots on a pitch, and all parts of a host but the network."""

    def __init__(self, profile_name: str, count: int) -> None:
        self.profile = profile = load_profile(profile_name)
        self.roster = roster_of(count, RobotModel.standard(profile))
        self.world = World(profile, self.roster, ARENA)
        self.raw = Engine(profile, self.roster)
        self.world.place(self._spread())
        self.world.make_checkpoint()
        streams = RandomStreams(1)
        self.radio = RadioAir(profile.radio, self.roster, profile.time.tick, streams)
        self.perception = Perception(profile.sensing, self.roster, streams, profile.time.tick)
        self.sights = Sights(self.roster, self.perception, self.radio, SensorSuite(profile, self.roster, streams))
        self.alone, self.seen = Perception(profile.sensing, self.roster, streams, profile.time.tick), 0
        book = load_rule_book("friendly")
        starts = {at.body: Pose(at.x, at.y) for at in self._spread() if at.body != "ball"}
        self.referee = Referee(
            book,
            profile.field,
            profile.ball,
            self.roster,
            duration=86_400,
            kick_off=Side.CYAN,
            automatic=False,
            starts=starts,
        )
        self.state = self.referee.begin()
        applied = AppliedInput(Drive(vx=0.4, omega=1.0), dribble=True)
        self.inputs = dict.fromkeys(self.roster.names, applied)
        self.snapshot: Snapshot = self.world.snapshot()

    def close(self) -> None:
        self.world.close()
        self.raw.close()

    def _spread(self) -> list[Placement]:
        """All robots on a grid as wide as the pitch allows; the ball in front of the first."""
        field, names = self.profile.field, self.roster.names
        columns = math.ceil(math.sqrt(len(names) * field.length / field.width))
        rows = math.ceil(len(names) / columns)
        placements = [
            Placement(
                body=name,
                x=((place % columns + 0.5) / columns - 0.5) * field.length,
                y=((place // columns + 0.5) / rows - 0.5) * field.width,
            )
            for place, name in enumerate(names)
        ]
        first = placements[0]
        return [*placements, Placement(body="ball", x=first.x + self.profile.dribble.gap, y=first.y)]

    def step_raw(self) -> None:
        """One step of a plain PyBullet program."""
        self.raw.set_velocities(self._drives)
        self.raw.step()
        self.raw.read()

    def step_world(self) -> None:
        """The world of one tick, with its hash."""
        self.advance = self.world.advance(self.inputs)
        self.snapshot = self.advance.snapshot
        self.world.chain()

    def sense(self) -> None:
        """Perception of all robots in successive ticks, without encoding."""
        self.seen += 1
        list(self.alone.at(replace(self.snapshot, tick=self.seen), 1))

    def tick(self) -> None:
        """Everything of one tick."""
        self.step_world()
        ruling = self.referee.step(self.state, self.snapshot, (), self.profile.time.tick)
        self.state = ruling.state
        views = partial(self.referee.views, self.state, 1)
        self.sights.at(self.snapshot, self.state.cyan_attacks, views, self.advance.stuck, {}, {}, {}, discard)

    def ready(self) -> None:
        """Set the raw engine to the world's state."""
        self.raw.rebuild(self.snapshot.robots, self.snapshot.ball)
        self._drives = [(robot.vx, robot.vy, robot.omega) for robot in self.snapshot.robots]


def discard(_robot: str, _sight: bytes) -> None:
    """A publisher without readers."""


def timed(body: Callable[[], None], least_calls: int = 1) -> float:
    """CPU time of one call in s, averaged over the calls that fill a round, which are multiples of `least_calls`."""
    calls, began = 0, time.process_time()
    while True:
        for _ in range(least_calls):
            body()
        calls += least_calls
        spent = time.process_time() - began
        if spent > SECONDS_A_ROUND:
            return spent / calls


def measure(profile_name: str, count: int) -> Cost:
    """Medians over several rounds; in each round everything has its turn."""
    rig = TickRig(profile_name, count)
    rig.step_world()
    steps = rig.profile.time.steps_per_tick
    rows = []
    for _ in range(ROUNDS):
        rig.ready()
        tick = timed(rig.tick, TICKS_A_ROUND)
        rows.append((timed(rig.step_raw), timed(rig.step_world) / steps, timed(rig.sense, TICKS_A_ROUND), tick))
    rig.close()
    raw, world, sensing, tick = (statistics.median(column) for column in zip(*rows, strict=True))
    return Cost(raw, world, sensing, tick, steps)


def exponent(costs: list[float]) -> float:
    """p of cost ~ n^p, over the sizes."""
    x, y = [math.log(size) for size in SIZES], [math.log(cost) for cost in costs]
    slope, _ = statistics.linear_regression(x, y)
    return slope


def main() -> None:
    """Print the table and the cost of sensing."""
    console = Console(width=120)
    table = Table(title="physics steps per second of CPU time, medians", box=None)
    for column in ("model", "robots", "raw", "world", "tick", "world/raw", "tick/raw"):
        table.add_column(column, justify="left" if column == "model" else "right")
    costs = {(name, count): measure(name, count) for name in PROFILES for count in SIZES}
    for name in PROFILES:
        model = load_profile(name).drive.model
        for count in SIZES:
            raw, world, tick = costs[name, count].per_step
            rates = [f"{1 / cost:.0f}" for cost in (raw, world, tick)]
            table.add_row(model, str(count), *rates, f"{world / raw:.2f}", f"{tick / raw:.2f}")
        columns = zip(*[costs[name, count].per_step for count in SIZES], strict=True)
        table.add_row(model, "n^p", *[f"p = {exponent(list(column)):.2f}" for column in columns])
    console.print(table)
    raw, _, tick = costs["msl", SIZES[-1]].per_step
    console.print(f"a tick of {SIZES[-1]} robots: {tick / raw:.2f} x raw (at most {MOST_TICK_COST})")
    for name in PROFILES:
        cost = costs[name, 10]
        physics = cost.world * cost.steps_per_tick
        console.print(
            f"sensing of ten robots, {load_profile(name).drive.model}: {cost.sensing * 1e6:.0f} us for a tick whose "
            f"physics takes {physics * 1e6:.0f} us, ratio {cost.sensing / physics:.2f} (below 1)"
        )


if __name__ == "__main__":
    main()
