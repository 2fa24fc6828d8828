"""The environment of one robot: Gymnasium's own check, vectors of environments, and errors."""

from pathlib import Path

import gymnasium
import numpy as np
import pettingzoo
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

from schemas.errors import TouchlineError
from support import display
from support.imports import forgotten_imports
from support.rover_task import write_rover_task
from touchline.learn import RobotEnv
from touchline.learn.registry import ANY_TASK, environment_name

KEEPAWAY = environment_name("keepaway_3v2")


@pytest.mark.filterwarnings("ignore:.*disable_env_checker.*")
def test_gymnasium_finds_its_api_kept() -> None:
    with display.backend("module://support.display"):
        check_env(gymnasium.make(KEEPAWAY, disable_env_checker=True).unwrapped)


def test_one_robot_learns_and_its_teammates_play() -> None:
    env = RobotEnv("keepaway_3v2", robot="cyan3")
    observation, info = env.reset(seed=4)
    assert env.observation_space.contains(observation) and info["seed"] == 4
    assert [entry.name for entry in env.action_entries] == ["vx", "vy", "omega", "kick", "power", "dribble"]
    assert len(env.observation_entries) == len(observation)
    with pytest.raises(TouchlineError, match='did you mean "cyan3"'):
        RobotEnv("keepaway_3v2", robot="cyan33")


def test_a_task_is_made_from_the_path_of_its_file_and_an_unknown_one_is_named(tmp_path: Path) -> None:
    path = write_rover_task(tmp_path)
    with forgotten_imports(tmp_path):
        team = pettingzoo.make("parallel", ANY_TASK, task=path)
        robot = gymnasium.make(ANY_TASK, task=path, robot="two")
        observations, _ = team.reset(3)
        observation, _ = robot.reset(seed=3)
        team.close()
        robot.close()
    assert {*observations} == {"one", "two"} and np.array_equal(observation, observations["two"])
    with pytest.raises(TouchlineError, match="no task is named"):
        gymnasium.make(ANY_TASK, task="keepaway_3v3")


@pytest.mark.slow
def test_many_environments_step_in_processes_of_their_own_with_shared_memory() -> None:
    envs = gymnasium.make_vec(KEEPAWAY, num_envs=2, vectorization_mode="async", max_cycles=3)
    assert envs.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    observations, infos = envs.reset(seed=[3, 3])
    assert infos["seed"].tolist() == [3, 3]
    assert observations[0].tolist() == observations[1].tolist()
    actions = np.zeros(envs.action_space.shape, np.float32)
    ends = [envs.step(actions)[3].tolist() for _ in range(5)]
    assert ends == [[False, False], [False, False], [True, True], [False, False], [False, False]]
    envs.close()
