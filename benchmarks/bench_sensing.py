"""CPU time of sensing and of encoding sights for ten robots, against the physics of the same ticks, in one run.

Sensing: `Perception.at` for all robots, mean of ticks with and without a picture. Beams: a hundred for each robot, ten
times a second, as common range finders have them, and as often as the camera takes pictures. Sights: `Sights.at`, which
includes sensing. Physics: setting velocities, stepping and reading in the bare engine, for all steps of a tick; and
`World.advance`, which adds actuation, dribbling and contacts.
"""

import dataclasses
import math
import statistics
import time
from collections.abc import Callable

from bench_host_step import commands

from schemas.config.match_config import load_match
from schemas.config.sensors.range import RangeFinder
from sim_host.match.simulation import Simulation
from sim_host.physics.engine import Engine
from sim_host.sensing.perception import Perception
from sim_host.sensing.random_streams import RandomStreams
from sim_host.sensing.sensors.suite import SensorSuite

ROUNDS = 8
BEAMS = RangeFinder(beams=100, span=math.tau, max_distance=8.0, noise=0.02, dropout=0.01)
TICKS = 256
"""In a round; most random numbers are drawn for as many ticks at once."""


class Timed:
    """Wraps a function and adds up the CPU time of its calls."""

    def __init__(self, function: Callable[..., object]) -> None:
        self._function = function
        self.seconds = 0.0

    def __call__(self, *given: object) -> object:
        """Call the function."""
        began = time.thread_time()
        result = self._function(*given)
        self.seconds += time.thread_time() - began
        return result


def main() -> None:
    """Print the median cost of each per tick."""
    simulation = Simulation(load_match(None, {"duration": 86_400}))
    profile, roster = simulation.profile, simulation.roster
    perception = Perception(profile.sensing, roster, RandomStreams(2), profile.time.tick)
    suites = [
        SensorSuite(
            dataclasses.replace(profile, sensors={"standard": {"front": dataclasses.replace(BEAMS, rate=rate)}}),
            roster,
            RandomStreams(2),
        )
        for rate in (10.0, profile.sensing.camera_rate)
    ]
    raw = Engine(profile, roster)
    drives = [(0.3, 0.1 * place, 0.3) for place in range(len(roster.names))]

    def physics() -> None:
        for _ in range(profile.time.steps_per_tick):
            raw.set_velocities(drives)
            raw.step()
            raw.read()

    rows = []
    for _ in range(ROUNDS):
        raw.rebuild(simulation.world.snapshot().robots, simulation.world.snapshot().ball)
        sense, bare = Timed(lambda *given: list(perception.at(*given))), Timed(physics)
        scan, often = (Timed(suite.at) for suite in suites)
        write, advance = Timed(simulation._subsystems.sights.at), Timed(simulation.world.advance)
        simulation._subsystems.sights.at, simulation.world.advance = write, advance  # type: ignore[method-assign, assignment]
        for _ in range(TICKS):
            simulation.step(commands(simulation, simulation.now.tick), send=lambda *_: None)
            snapshot = simulation.world.snapshot()
            sense(snapshot, simulation.state.cyan_attacks)
            scan(snapshot)
            often(snapshot)
            bare()
        del simulation._subsystems.sights.at, simulation.world.advance
        rows.append([timed.seconds / TICKS * 1e6 for timed in (sense, scan, often, write, bare, advance)])
    sensing, scans, frequent, sights, physics_us, world = (
        statistics.median(column) for column in zip(*rows, strict=True)
    )
    print(
        f"a tick of ten robots: sensing {sensing:.0f} us, sights with it {sights:.0f} us; physics {physics_us:.0f} us "
        f"raw (set, step, read), {world:.0f} us with actuation; sensing / raw physics {sensing / physics_us:.2f} "
        f"(below 1), sights / physics {sights / world:.2f} (below 1); "
        f"100 beams {scans:.0f} us, beams / sensing {scans / sensing:.2f}, "
        f"{frequent / sensing:.2f} at the camera's rate (at most 1)"
    )


if __name__ == "__main__":
    main()
