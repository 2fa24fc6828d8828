"""Trains teams by imitation and PPO, and plays their policies against the baseline brain on seeds of their own.

    pip install 'touchline[learn,sim,study]' stable-baselines3
    python examples/learn/ppo.py coverage

The robots of a team share one policy. It begins with what the baseline brain can do, because noise alone hardly ever
leads a robot anywhere: it imitates the brain first, or it only corrects the commands that the brain gives (residual
learning); then PPO improves it. Policies and a picture of the curves are left in runs/ppo-TASK.
"""

import itertools
import shlex
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import torch
from imitation import imitate
from report import Curve, parser_of, report
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecMonitor, VecNormalize
from teams import Teams

from touchline.learn import TaskEnv


@dataclass(frozen=True)
class Settings:
    """How a task is learned."""

    parameters: dict[str, object] = field(default_factory=dict)
    """Of the team: what its robots observe, and how often they decide. A match that plays the policy has the same."""
    teams: int = 4
    """Teams that play side by side, and give the samples of one update."""
    steps: int = 256
    """Decisions of each robot between two updates."""
    imitation: float = 0.25
    """Share of the time for imitation."""
    noise: float = 0.2
    """Standard deviation of the actions with which PPO begins: small, so that what the brain can do stays."""
    weights: dict[str, float] = field(default_factory=dict)
    """Entry of the observation → standard deviation with which its weight is tried. With these a policy is linear, and
    its other weights are 0: it needs the least experience. What is tried stays the same for some decisions (`use_sde`),
    and the critic observes all."""
    warm_up: int = 4
    """Updates of the critic alone, before the first one of the policy."""
    ppo: dict[str, Any] = field(default_factory=lambda: {"batch_size": 256, "target_kl": 0.03})
    """Of Stable-Baselines3."""


SETTINGS = {
    "coverage": Settings(),
    # In so few episodes PPO does not win back what imitation loses of this brain's aim and timing. So it corrects the
    # brain, in one number: how fast a robot drives along its kick axis while it holds the ball.
    "pass_and_shoot": Settings(
        {
            "corrects": "touchline.tasks.pass_and_shoot:Attacker",
            "act": "vx",
            "observe": "place ball goals time",
            "decision_ticks": 15,
        },
        teams=8,
        steps=48,
        imitation=0.0,
        weights={"ball.held": 0.4},
        warm_up=2,
        ppo={"batch_size": 128, "target_kl": 0.05, "learning_rate": 1.5e-2, "use_sde": True, "sde_sample_freq": 6},
    ),
}


class Minutes(BaseCallback):
    """Ends the training in time, holds the policy still while the critic is new, and notes the scores of episodes."""

    def __init__(self, begun: float, end: float, settings: Settings) -> None:
        """Begin and end are CPU time of this process in s."""
        super().__init__()
        self.begun, self.end, self.settings, self.updates = begun, end, settings, 0
        self.curve: Curve = []

    def _on_rollout_start(self) -> None:
        policy = self.model.policy
        learns = self.updates >= self.settings.warm_up
        for part in (policy.mlp_extractor.policy_net, policy.action_net):
            part.requires_grad_(learns)
        policy.log_std.requires_grad_(learns and not self.settings.weights)
        self.updates += 1

    def _on_rollout_end(self) -> None:
        if scores := [episode["score"] for episode in self.model.ep_info_buffer]:
            self.curve.append(((time.process_time() - self.begun) / 60, float(np.mean(scores))))

    def _on_step(self) -> bool:
        return time.process_time() < self.end


def train(task: str, run: int, minutes: float, file: Path) -> Curve:
    """Train one policy; its curve."""
    torch.set_num_threads(1)
    begun, settings = time.process_time(), SETTINGS.get(task, Settings())
    seeds: Iterator[int] = itertools.count(1_000_000 * run)
    envs = [TaskEnv(task, parameters=settings.parameters) for _ in range(settings.teams)]
    teams = VecNormalize(VecMonitor(Teams(envs, seeds), info_keywords=("score",)), norm_obs=False)
    model = PPO(
        "MlpPolicy",
        teams,
        n_steps=settings.steps,
        n_epochs=8,
        policy_kwargs={
            "net_arch": {"pi": [] if settings.weights else [64, 64], "vf": [64, 64]},
            "log_std_init": float(np.log(settings.noise)),
        },
        stats_window_size=64,
        seed=run,
        device="cpu",
        **settings.ppo,
    )
    if settings.weights:
        names = [entry.name for entry in envs[0].observation_entries(envs[0].possible_agents[0])]
        learn_only(model, {names.index(name): noise for name, noise in settings.weights.items()})
    if settings.imitation:
        advised = TaskEnv(task, parameters=settings.parameters, advice=True)
        imitate(model, advised, seeds, 60 * minutes * settings.imitation)
    noted = Minutes(begun, begun + 60 * minutes, settings)
    model.learn(10**9, callback=noted)
    model.save(file)
    teams.close()
    return noted.curve


def learn_only(model: PPO, weights: dict[int, float]) -> None:
    """Begin with zeros, and learn the weights of these observations alone, with this noise on them."""
    policy = model.policy
    learned = torch.zeros_like(policy.action_net.weight)
    policy.action_net.weight.data.zero_()
    policy.action_net.bias.data.zero_()
    policy.log_std.data.fill_(float(np.log(1e-3)))
    for place, noise in weights.items():
        learned[:, place] = 1.0
        policy.log_std.data[place] = float(np.log(noise))
    policy.action_net.weight.register_hook(lambda gradient: gradient * learned)
    policy.action_net.bias.register_hook(torch.zeros_like)


def main() -> None:
    """Train, score, draw."""
    parser = parser_of(__doc__)
    parser.add_argument("task", help="a task by name, or the path of its match file")
    options = parser.parse_args()
    task, folder = options.task, Path("runs") / f"ppo-{Path(options.task).stem}"
    folder.mkdir(parents=True, exist_ok=True)
    files = {f"run {run}": folder.absolute() / f"run{run}.zip" for run in range(1, options.runs + 1)}
    parameters = SETTINGS.get(task, Settings()).parameters
    overrides = {f"teams.cyan.parameters.{key}": value for key, value in parameters.items()}
    runs = {run: (f"policy:{file}", overrides) for run, file in files.items()}
    with ProcessPoolExecutor(options.jobs, get_context("spawn")) as pool:
        begun = [pool.submit(train, task, run, options.minutes, file) for run, file in enumerate(files.values(), 1)]
        report(pool, task, runs, [one.result() for one in begun], folder, options.episodes)
    given = [word for key, value in overrides.items() for word in ("--set", f"{key}={value}")]
    print(shlex.join(["touchline", "task", "run", task, "--brain", f"policy:{folder / 'run1.zip'}", *given]))


if __name__ == "__main__":
    main()
