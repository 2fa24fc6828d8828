"""The rules, in order: the first that decides in a tick is the only one to decide; a new rule is a file and a row."""

from collections.abc import Callable
from dataclasses import dataclass

from sim_host.referee.decision import Decision
from sim_host.referee.rules import goal, goal_line, half_end, lost_ball, stall, touch_line
from sim_host.referee.scene import Scene


@dataclass(frozen=True, slots=True)
class Rule:
    """One row: the file's name, its judgement, and whether it judges only while the game runs, after START."""

    name: str
    judge: Callable[[Scene], Decision | None]
    while_running: bool = True


RULES: tuple[Rule, ...] = (
    Rule("goal", goal.judge),
    Rule("touch_line", touch_line.judge),
    Rule("goal_line", goal_line.judge),
    Rule("lost_ball", lost_ball.judge),
    Rule("stall", stall.judge),
    Rule("half_end", half_end.judge, while_running=False),
)

RUNNING = RULES
"""The rules that judge after START."""
HALTED = tuple(rule for rule in RULES if not rule.while_running)
"""The rules that judge at any time."""


def first_decision(scene: Scene) -> tuple[Rule, Decision] | None:
    """The first rule that decides in this tick, with what it decides."""
    for rule in RUNNING if scene.state.running else HALTED:
        decision = rule.judge(scene)
        if decision is not None:
            return rule, decision
    return None
