"""Tasks as environments of PettingZoo and Gymnasium: importing this package registers those that ship.

    import pettingzoo
    import touchline.learn

    env = pettingzoo.make("parallel", "Touchline/Keepaway3v2-v0")

An environment steps the match itself: the same physics, sensors, radio and referee.
"""

from schemas.errors import TouchlineError
from touchline.policy.network import Network

try:
    from touchline.learn.registry import register_tasks
    from touchline.learn.robot_env import RobotEnv
    from touchline.learn.scores import scores
    from touchline.learn.task_env import TaskEnv
except ModuleNotFoundError as error:
    if error.name not in ("gymnasium", "pettingzoo"):
        raise
    raise TouchlineError(f"touchline.learn needs {error.name}; run pip install 'touchline[learn]'") from None

register_tasks()

__all__ = ["Network", "RobotEnv", "TaskEnv", "scores"]
