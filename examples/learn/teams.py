"""The robots of several teams as the learners of one policy, for Stable-Baselines3."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from stable_baselines3.common.vec_env import VecEnv

from touchline.learn import TaskEnv


class Teams(VecEnv):
    """Some environments of a task in this process, one after the other; each of their robots is a learner."""

    def __init__(self, envs: list[TaskEnv], seeds: Iterator[int]) -> None:
        """`seeds` are those of the episodes, in the order in which they begin."""
        self.envs, self.seeds, self.robots = envs, seeds, envs[0].possible_agents
        robot = self.robots[0]
        spaces = envs[0].observation_space(robot), envs[0].action_space(robot)
        super().__init__(len(envs) * len(self.robots), *spaces)

    def begin(self, env: TaskEnv) -> dict[str, np.ndarray]:
        """Begin the episode of the next seed."""
        return env.reset(seed=next(self.seeds))[0]

    def reset(self) -> np.ndarray:
        """Begin an episode in each environment."""
        return np.stack([seen for env in self.envs for seen in self.begin(env).values()])

    def step_async(self, actions: np.ndarray) -> None:
        """Note the actions, shape (learners, entries)."""
        self.actions = actions.reshape(len(self.envs), len(self.robots), -1)

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        """Play until the next decision; an episode that has ended is followed by the next one."""
        rows: list[np.ndarray] = []
        rewards: list[float] = []
        dones: list[bool] = []
        infos: list[dict[str, Any]] = []
        for env, actions in zip(self.envs, self.actions, strict=True):
            seen, reward, _, truncated, info = env.step(dict(zip(self.robots, actions, strict=True)))
            over = not env.agents
            for robot in self.robots:
                infos.append({**info[robot], "TimeLimit.truncated": truncated[robot]})
                if over:
                    infos[-1]["terminal_observation"] = seen[robot]
            rewards += reward.values()
            dones += [over] * len(self.robots)
            rows += (self.begin(env) if over else seen).values()
        return np.stack(rows), np.array(rewards, np.float32), np.array(dones), infos

    def close(self) -> None:
        """Free the engines."""
        for env in self.envs:
            env.close()

    def get_attr(self, attr_name, indices=None):
        """The same attribute for each learner."""
        return [getattr(self, attr_name, None)] * self.number_of(indices)

    def set_attr(self, attr_name, value, indices=None):
        """Learners have no attributes of their own."""
        raise NotImplementedError

    def env_method(self, method_name, *args, indices=None, **kwargs):
        """Learners have no methods of their own."""
        raise NotImplementedError

    def env_is_wrapped(self, _wrapper_class, indices=None):
        """None is."""
        return [False] * self.number_of(indices)

    def number_of(self, indices):
        """How many learners are meant: None is all, a number one."""
        return self.num_envs if indices is None else np.size(indices)
