"""The rules, in order: the first that decides in a tick is the only one to decide; a new rule is a file and a row."""

from collections.abc import Callable
from dataclasses import dataclass

from schemas.game import Stage
from sim_host.referee.decision import Decision
from sim_host.referee.rules import (
    double_touch,
    dragged,
    early_touch,
    goal,
    goal_line,
    half_end,
    lost_ball,
    shoot_out,
    stall,
    touch_line,
)
from sim_host.referee.scene import Scene


@dataclass(frozen=True, slots=True)
class Rule:
    """One row: the file's name, its judgement, and whether it judges only while the game runs, after START."""

    name: str
    judge: Callable[[Scene], Decision | None]
    while_running: bool = True


RULES: tuple[Rule, ...] = (
    Rule("early_touch", early_touch.judge),
    Rule("double_touch", double_touch.judge),
    Rule("dragged", dragged.judge),
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
"""The rules that judge at any time: those on the clocks, which are all that judge where people officiate."""
SHOOT_OUT: tuple[Rule, ...] = (Rule("shoot_out", shoot_out.judge),)
"""The rules of the penalty shoot-out."""


def first_decision(scene: Scene, *, clocks_alone: bool = False) -> tuple[Rule, Decision] | None:
    """The first rule that decides in this tick, with what it decides."""
    for rule in _rules(scene, clocks_alone):
        decision = rule.judge(scene)
        if decision is not None:
            return rule, decision
    return None


def _rules(scene: Scene, clocks_alone: bool) -> tuple[Rule, ...]:
    if clocks_alone or not scene.state.running:
        return HALTED
    return SHOOT_OUT if scene.state.stage is Stage.SHOOT_OUT else RUNNING
