"""Answers of a robot whose test has no loop of its own."""

from robot_agent.process.runner import Runner


def answer_next(runner: Runner) -> bool:
    """Answer the newest sight, if there is one; returns whether there was one."""
    sight = runner.next_sight(0.0)
    if sight is not None:
        runner.answer(sight)
    return sight is not None
