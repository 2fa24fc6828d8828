"""Trains teams by imitation and PPO, and plays their policies against the baseline brain on seeds of their own.

    pip install 'touchline[learn,sim,study]' stable-baselines3
    python examples/learn/ppo.py coverage

The robots of a team share one policy. It imitates the baseline brain first, because noise alone hardly ever leads a
robot anywhere; then PPO improves it. Policies and a picture of the curves are left in runs/ppo-TASK.
"""

import itertools
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path

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


SETTINGS = {
    "coverage": Settings(),
    "pass_and_shoot": Settings(
        {"decision_ticks": 3, "obstacles": 2, "observe": "place motion ball goals mates obstacles time"}, 8, 128
    ),
}
NOISE = 0.2
"""Standard deviation of the actions with which PPO begins: small, so that what was imitated stays."""
WARM_UP = 4
"""Updates of the critic alone, before the first one of the policy."""


class Minutes(BaseCallback):
    """Ends the training in time, holds the policy still while the critic is new, and notes the scores of episodes."""

    def __init__(self, begun: float, end: float) -> None:
        """Both are CPU time of this process in s."""
        super().__init__()
        self.begun, self.end, self.updates = begun, end, 0
        self.curve: Curve = []

    def _on_rollout_start(self) -> None:
        policy = self.model.policy
        for part in (policy.mlp_extractor.policy_net, policy.action_net, policy.log_std):
            part.requires_grad_(self.updates >= WARM_UP)
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
        batch_size=256,
        n_epochs=8,
        target_kl=0.03,
        policy_kwargs={"net_arch": [64, 64], "log_std_init": float(np.log(NOISE))},
        stats_window_size=64,
        seed=run,
        device="cpu",
    )
    advised = TaskEnv(task, parameters=settings.parameters, advice=True)
    imitate(model, advised, seeds, 60 * minutes * settings.imitation)
    noted = Minutes(begun, begun + 60 * minutes)
    model.learn(10**9, callback=noted)
    model.save(file)
    teams.close()
    return noted.curve


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


if __name__ == "__main__":
    main()
