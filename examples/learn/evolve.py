"""Evolves a small network for a team by CMA-ES: python examples/learn/evolve.py keepaway_3v2 --minutes 10

The robots share one network, which sees what each of them perceives and nothing else. The best one is written for the
brain `policy:FILE`.
"""

import argparse
import time
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np
from cmaes import SepCMA

from touchline.learn import Network, TaskEnv

HIDDEN = 8


@cache
def environment(task: str, observe: str | None) -> TaskEnv:
    """One in each process."""
    return TaskEnv(task, parameters={"observe": observe} if observe else {})


def sizes(env: TaskEnv) -> tuple[int, int, int]:
    robot = env.possible_agents[0]
    return len(env.observation_entries(robot)), HIDDEN, len(env.action_entries(robot))


def play(task: str, observe: str | None, parameters: np.ndarray, seeds: list[int]) -> float:
    """The mean reward of a network in the episodes of these seeds."""
    env = environment(task, observe)
    network, total = Network.of(parameters, sizes(env)), 0.0
    for seed in seeds:
        observations, _ = env.reset(seed)
        while env.agents:
            actions = {robot: network.action(seen) for robot, seen in observations.items()}
            observations, rewards, *_ = env.step(actions)
            total += next(iter(rewards.values()))
    return total / len(seeds)


def main() -> None:
    """Evolve until the time is over."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("task")
    options.add_argument("--minutes", type=float, default=10.0)
    options.add_argument("--generations", type=int, default=10_000)
    options.add_argument("--episodes", type=int, default=8, help="of each network in each generation")
    options.add_argument("--observe", help="groups of observations; all by default")
    options.add_argument("--processes", type=int, default=2)
    options.add_argument("--out", type=Path, default=Path("policy.npz"))
    chosen = options.parse_args()
    env = environment(chosen.task, chosen.observe)
    search = SepCMA(mean=np.zeros(Network.size(sizes(env))), sigma=0.3, seed=1)
    end, task = time.monotonic() + 60 * chosen.minutes, (chosen.task, chosen.observe)
    with ProcessPoolExecutor(chosen.processes) as pool:
        for generation in range(chosen.generations):
            if time.monotonic() > end:
                break
            asked = [search.ask() for _ in range(search.population_size)]
            first = 1000 + generation * chosen.episodes  # seeds below 1000 are for measuring
            seeds = list(range(first, first + chosen.episodes))
            rewards = [pool.submit(play, *task, one, seeds) for one in asked]
            search.tell([(one, -reward.result()) for one, reward in zip(asked, rewards, strict=True)])
            mean = np.mean([reward.result() for reward in rewards])
            print(f"generation {generation + 1}: {mean:.3f} on average", flush=True)
            Network.of(search.mean, sizes(env)).save(chosen.out)


if __name__ == "__main__":
    main()
