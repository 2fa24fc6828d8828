"""The names under which PettingZoo and Gymnasium make the tasks that ship."""

import gymnasium
import pettingzoo

from touchline.matches.task.task import shipped_tasks

_TEAM = "touchline.learn.task_env:TaskEnv"
_ROBOT = "touchline.learn.robot_env:RobotEnv"
ANY_TASK = "Touchline/Task-v0"
"""The environment of a task of a user's own: `task` is the path of its match file."""


def environment_name(task: str) -> str:
    """The name of a task's environment: `Touchline/Keepaway3v2-v0` of `keepaway_3v2`."""
    return f"Touchline/{''.join(part.capitalize() for part in task.split('_'))}-v0"


def register_tasks() -> None:
    """Register all tasks, and one for any task: for the whole team with PettingZoo, for one robot with Gymnasium."""
    gymnasium.register(ANY_TASK, entry_point=_ROBOT)
    pettingzoo.register("parallel", ANY_TASK, entry_point=_TEAM)
    for task in shipped_tasks():
        gymnasium.register(environment_name(task), entry_point=_ROBOT, kwargs={"task": task})
        pettingzoo.register("parallel", environment_name(task), entry_point=_TEAM, kwargs={"task": task})
