"""One physics step of the host, everything included, against a plain PyBullet loop of the same world.

Host: ten robots that drive, dribble and send radio messages; actuation, contacts, sensing with noise, radio, referee,
hash chain, and every message encoded. Raw: the same bodies in the same engine, in the loop of any PyBullet program: set
ten velocities, step, read eleven bodies. Both run in one process, in turns.
"""

import math
import statistics
import time
from collections.abc import Callable

from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from schemas.messages.radio import BallBelief, Motion, Radio
from schemas.wire.message import VERSION
from schemas.wire.part import encode
from sim_host.match.simulation import Simulation
from sim_host.physics.engine import Engine

ROUNDS = 15
TURNS = 5
"""In a round, so that each gets its share of the random numbers that are drawn for hundreds of ticks at once."""
TICKS = 100
"""In a turn; in more, the raw bodies, which drive straight ahead, would reach the boundary."""


def timed(body: Callable[[], None]) -> float:
    """Duration of a call in s."""
    began = time.perf_counter()
    body()
    return time.perf_counter() - began


def commands(simulation: Simulation, tick: int) -> dict[str, Command]:
    """Commands of ten robots for a tick, as the host decodes them.

    Each robot drives a circle of its own, 0.7 m wide, and sends a radio message in every fifth tick.
    """
    radio = Radio(self=Motion(x=1, y=2, heading=0.1), ball=BallBelief(x=1, y=2), role="striker", intention="shoot")
    return {
        name: Command.decode(
            Command(
                answers_tick=tick,
                drive=Drive(vx=math.cos(place), vy=math.sin(place), omega=3.0),
                dribble=True,
                radio=radio if (tick + place) % 5 == 0 else None,
            ).encode()
        )
        for place, name in enumerate(simulation.roster.names)
    }


def main() -> None:
    """Print the median cost of both, and their ratio."""
    simulation = Simulation(load_match(None, {"duration": 86_400}))
    steps = simulation.profile.time.steps_per_tick
    inputs: list[dict[str, Command]] = []

    def host() -> None:
        for commanded in inputs:
            tick = simulation.step(commanded, send=lambda *_: None)  # encodes sights, beliefs and inputs
            encode({"version": VERSION, **tick.world})  # as `Publisher.put_fields` does

    raw = Engine(simulation.profile, simulation.roster)
    drives = [(math.cos(place), math.sin(place), 0.3) for place in range(len(raw.robots))]

    def loop() -> None:
        for _ in range(TICKS * steps):
            raw.set_velocities(drives)
            raw.step()
            raw.read()

    def engine_alone() -> None:
        for _ in range(TICKS * steps):
            raw.step()

    def ready() -> None:
        now = simulation.now.tick
        inputs[:] = [commands(simulation, tick) for tick in range(now, now + TICKS)]
        raw.rebuild(simulation.world.snapshot().robots, simulation.world.snapshot().ball)

    def turn() -> list[float]:
        ready()
        return [timed(body) / TICKS / steps * 1e6 for body in (host, loop, engine_alone)]

    rows = [
        [statistics.mean(column) for column in zip(*[turn() for _ in range(TURNS)], strict=True)] for _ in range(ROUNDS)
    ]
    host_us, raw_us, alone_us = (statistics.median(column) for column in zip(*rows, strict=True))
    ratio = statistics.median(row[0] / row[1] for row in rows)
    print(
        f"host step: {host_us:.0f} us per physics step with everything, {raw_us:.0f} us raw (set, step, read), "
        f"ratio {ratio:.2f} (at most 2.5); stepSimulation alone {alone_us:.0f} us"
    )


if __name__ == "__main__":
    main()
