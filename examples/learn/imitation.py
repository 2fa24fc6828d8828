"""Imitation of the baseline brain (DAgger): the brain says what it would do wherever the policy leads the robots."""

import time
from collections.abc import Iterator

import numpy as np
import torch
from stable_baselines3 import PPO

from touchline.learn import TaskEnv

BATCH = 512
"""Decisions in a gradient step."""
RATE = 1e-3
"""Learning rate of the imitation."""
KICKS = 10.0
"""Weight of decisions with a kick, which are rare."""
NO_KICK = -0.4
"""What is imitated where the brain does not kick: nearer to a kick than −1, so that noise tries some."""


def imitate(model: PPO, env: TaskEnv, seeds: Iterator[int], seconds: float) -> None:
    """Fit the policy to the advice of the brain, for some CPU time; first the brain drives, later the policy."""
    optimizer = torch.optim.Adam(model.policy.parameters(), RATE)
    names = [entry.name for entry in env.action_entries(env.possible_agents[0])]
    seen: list[np.ndarray] = []
    advised: list[np.ndarray] = []
    begun = time.process_time()
    while (now := time.process_time() - begun) < seconds:
        brain_drives = np.random.random() > 1.5 * now / seconds
        observed, infos = env.reset(seed=next(seeds))
        while env.agents:
            actions = {robot: info["advice"] for robot, info in infos.items()}
            seen += observed.values()
            advised += actions.values()
            if not brain_drives:
                rows, _ = model.predict(np.stack([*observed.values()]), deterministic=True)
                actions = dict(zip(actions, rows, strict=True))
            observed, _, _, _, infos = env.step(actions)
        played = time.process_time() - begun - now
        target = np.stack(advised)
        weights = np.ones_like(target)
        if "kick" in names:
            kick, power = names.index("kick"), names.index("power")
            kicks = target[:, kick] > 0.0
            weights[kicks], weights[~kicks, power] = KICKS, 0.0
            target[~kicks, kick] = NO_KICK
        fit(model, optimizer, (np.stack(seen), target, weights), played / 2)
    env.close()


def fit(model: PPO, optimizer: torch.optim.Optimizer, data: tuple[np.ndarray, ...], seconds: float) -> None:
    """Gradient steps for some CPU time; `data` are observations, actions, and weights of their entries."""
    end = time.process_time() + seconds
    while time.process_time() < end:
        chosen = np.random.randint(len(data[0]), size=BATCH)
        seen, target, weights = (torch.as_tensor(one[chosen]) for one in data)
        mean = model.policy.get_distribution(seen).distribution.mean
        loss = (weights * (mean - target) ** 2).mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
