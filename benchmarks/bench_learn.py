"""Steps per second of CPU time of environments with 1, 4 and 10 robots, and the CPU time of a reset.

A step is 0.1 s of simulated time: five control ticks, each with four steps of the physics, the referee, the radio, the
cameras with noise, and an observation and a command of every robot. All robots are agents and drive circles at random.
The last column is the share of the time that the bare engine takes: its steps alone, of as many cylinders.
"""

import statistics
import tempfile
import time
from pathlib import Path

import numpy as np
import pybullet
from rich.console import Console
from rich.table import Table

from touchline.learn import TaskEnv

STEPS, ROUNDS = 100, 5
PERIOD = 0.1
"""s."""
SCORE = """
from touchline import Moment

def played(now: Moment) -> float:
    return now.time
"""


def environment(folder: Path, robots: int) -> TaskEnv:
    """A match of this number of robots, all of one side, on a whole pitch."""
    (folder / "played.py").write_text(SCORE)
    places = [
        f'{{ name = "r{n}", side = "cyan", x = {-8.0 + 4.0 * (n % 5)}, y = {-3.0 + 6.0 * (n // 5)} }}'
        for n in range(robots)
    ]
    text = f"""
    duration = 3600.0
    rules = "friendly"
    [task]
    score = "played:played"
    [teams.cyan]
    brain = "simple"
    [scene]
    description = "Robots on a pitch."
    ball = {{ x = 0.0, y = 0.0 }}
    robots = [{", ".join(places)}]
    """
    file = folder / f"robots{robots}.toml"
    file.write_text(text)
    return TaskEnv(str(file))


def measured(env: TaskEnv) -> tuple[float, float]:
    """Steps per second, and ms of a reset."""
    begin = time.process_time()
    env.reset(1)
    reset_ms = 1e3 * (time.process_time() - begin)
    random, steps, spent = np.random.default_rng(1), 0, 0.0
    actions = [
        {agent: random.uniform(-0.4, 0.4, 6).astype(np.float32) for agent in env.possible_agents} for _ in range(STEPS)
    ]
    for action in actions:
        if not env.agents:
            env.reset(1)
        begin = time.process_time()
        env.step(action)
        spent, steps = spent + time.process_time() - begin, steps + 1
    return steps / spent, reset_ms


def bare(robots: int) -> float:
    """Periods per second of PyBullet alone: 20 steps of as many cylinders on a plane."""
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81, physicsClientId=client)
    pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client))
    hull = pybullet.createCollisionShape(pybullet.GEOM_CYLINDER, radius=0.25, height=0.8, physicsClientId=client)
    for n in range(robots):
        pybullet.createMultiBody(30, hull, basePosition=(2.0 * n, 0, 0.4), physicsClientId=client)
    begin = time.process_time()
    for _ in range(20 * STEPS):
        pybullet.stepSimulation(physicsClientId=client)
    spent = time.process_time() - begin
    pybullet.disconnect(client)
    return STEPS / spent


def main() -> None:
    """Print the table."""
    table = Table("robots", "steps/s", "× real time", "reset ms", "engine alone")
    with tempfile.TemporaryDirectory() as folder:
        for robots in (1, 4, 10):
            env = environment(Path(folder), robots)
            rates, resets, engines = [], [], []
            for _ in range(ROUNDS):
                rate, reset = measured(env)
                rates.append(rate)
                resets.append(reset)
                engines.append(bare(robots))
            env.close()
            rate, engine = statistics.median(rates), statistics.median(engines)
            row = [f"{robots}", f"{rate:.0f}", f"{rate * PERIOD:.1f}", f"{statistics.median(resets):.0f}"]
            row.append(f"{rate / engine:.0%}")
            table.add_row(*row)
    Console().print(table)


if __name__ == "__main__":
    main()
