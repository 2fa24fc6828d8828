"""A task as an environment of Gymnasium: one robot learns, the others are played by their brains."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from schemas.config.match_parts import Parameter
from touchline.learn.task_env import TaskEnv
from touchline.matches.task.task import load_task
from touchline.policy.entries import Entry


class RobotEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """The view of one robot of a `touchline.learn.task_env.TaskEnv`.

    What it learns plays in a match without anybody's sight but its own; its teammates may be played by the same policy
    of an earlier time: `overrides={"teams.cyan.brain": "policy:FILE"}`.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "human"], "render_fps": 10}

    def __init__(
        self,
        task: str | Path,
        *,
        robot: str | None = None,
        parameters: Mapping[str, Parameter] | None = None,
        overrides: Mapping[str, Any] | None = None,
        max_cycles: int | None = None,
        render_mode: str | None = None,
    ) -> None:
        """`robot` is the learner, by default the first of the task's side; for the others see `TaskEnv`.

        Raises:
            TouchlineError: there is no such task or robot, or the match file is invalid.
        """
        self._robot = robot if robot is not None else load_task(task, overrides=overrides).robots[0]
        self._team = TaskEnv(
            task,
            robots=[self._robot],
            parameters=parameters,
            overrides=overrides,
            max_cycles=max_cycles,
            render_mode=render_mode,
        )
        self.render_mode = render_mode
        self.observation_space = self._team.observation_space(self._robot)
        self.action_space = self._team.action_space(self._robot)

    @property
    def observation_entries(self) -> tuple[Entry, ...]:
        """Name, unit, scale and limits of each number of an observation."""
        return self._team.observation_entries(self._robot)

    @property
    def action_entries(self) -> tuple[Entry, ...]:
        """Name, unit and scale of each number of an action."""
        return self._team.action_entries(self._robot)

    @property
    def ended_by(self) -> str:
        """What ended the newest episode, as of `TaskEnv`."""
        return self._team.ended_by

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begin an episode, as `TaskEnv.reset` does."""
        super().reset(seed=seed)
        if seed is None:
            seed = int(self.np_random.integers(2**31))
        observations, infos = self._team.reset(seed, options)
        return observations[self._robot], infos[self._robot]

    def step(self, action: NDArray[np.float32]) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Keep the action in force until the next decision.

        Raises:
            TouchlineError: the action has another shape or is not finite, or no episode is going on.
        """
        observations, rewards, terminated, truncated, infos = self._team.step({self._robot: action})
        robot = self._robot
        return observations[robot], rewards[robot], terminated[robot], truncated[robot], infos[robot]

    def render(self) -> NDArray[np.uint8] | None:
        """With `rgb_array` a picture from above, shape (height, width, 3), else None."""
        return self._team.render()

    def close(self) -> None:
        """Free the engine, finish a recording, and close the window."""
        self._team.close()
