"""Robot agents: the contract of a brain, its runner, a world model, skills, the shipped teams. Knows no simulator."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robot_agent.process.settings import AgentSettings


def run(settings: "AgentSettings") -> int:
    """Run one robot's brain until the match is over, or until SIGINT or SIGTERM; the exit status of the process.

    Raises:
        TouchlineError: no host answers, or the brain cannot be made.
    """
    from robot_agent.process.run import run as run_process

    return run_process(settings)
