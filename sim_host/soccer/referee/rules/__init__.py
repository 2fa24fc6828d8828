"""The rules, in order: the first that decides in a tick is the only one. A new rule is a module and a row here."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import compress

from schemas.soccer.game import GameStage
from sim_host.soccer.referee.evidence.stays import NO_STAYS
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules import (
    backward,
    charging,
    double_touch,
    dragged,
    dribble_circle,
    early_touch,
    encroachment,
    goal,
    goal_area,
    goal_line,
    half_end,
    leaving_field,
    lob,
    long_hold,
    lost_ball,
    no_progress,
    not_rolling,
    own_goal_kick,
    own_half_goal,
    penalty_area,
    penalty_kick,
    pushing,
    scrum,
    shoot_out,
    stall,
    stand_off,
    touch_line,
)
from sim_host.soccer.referee.situation import Situation


@dataclass(frozen=True, slots=True)
class Rule:
    """One row: the name of the module, its judgement, its numbers, and when it is asked."""

    name: str
    judge: Callable[[Situation], Decision | None]
    numbers: tuple[str, ...] = ()
    """The numbers of the rule book that it uses, as `section.field`."""
    while_running: bool = True
    """It judges only after START."""
    occasion: str = "always"
    """The occasion, from `OCCASIONS`, without which it has nothing to judge: in a quiet tick few rules are asked."""


RESTART_FOUL = ("restarts.restart_fouls", "restarts.in_play_distance")
PENALTY = ("fouls.penalty_kick", "restarts.penalty_behind", "restarts.opponent_distance", "stall.still_speed")
RULES: tuple[Rule, ...] = (
    Rule("early_touch", early_touch.judge, RESTART_FOUL, occasion="set piece"),
    Rule("double_touch", double_touch.judge, RESTART_FOUL, occasion="set piece"),
    Rule("dragged", dragged.judge, (*RESTART_FOUL, "restarts.drag_distance"), occasion="set piece"),
    Rule("penalty_kick", penalty_kick.judge, PENALTY, occasion="set piece"),
    Rule(
        "encroachment",
        encroachment.judge,
        (
            "fouls.encroachment",
            *RESTART_FOUL,
            "restarts.opponent_distance",
            "restarts.teammate_distance",
            "restarts.encroach_margin",
            "restarts.encroach_retreat",
        ),
        occasion="set piece",
    ),
    Rule(
        "own_goal_kick", own_goal_kick.judge, ("scoring.robots_touched", "restarts.corner_inset"), occasion="crossing"
    ),
    Rule("own_half_goal", own_half_goal.judge, ("fouls.own_half_goal", "scoring.pass_roll"), occasion="crossing"),
    Rule(
        "goal",
        goal.judge,
        ("scoring.robots_touched", "restarts.drop_robots_to_score", "fouls.direct_goal"),
        occasion="crossing",
    ),
    Rule("touch_line", touch_line.judge, ("restarts.touch_line_inset",), occasion="crossing"),
    Rule("goal_line", goal_line.judge, ("restarts.corner_inset", "fouls.own_half_goal"), occasion="crossing"),
    Rule("lost_ball", lost_ball.judge, ("restarts.field_inset",)),
    Rule(
        "lob",
        lob.judge,
        ("fouls.lob", "scoring.lob_height", "scoring.lob_teammate", "scoring.lob_robots"),
        occasion="kick",
    ),
    Rule(
        "dribble_circle",
        dribble_circle.judge,
        ("fouls.dribble_circle", "handling.circle", "handling.release_gap"),
        occasion="dribble",
    ),
    Rule(
        "backward",
        backward.judge,
        (
            "fouls.backward",
            "handling.backward_distance",
            "handling.backward_once",
            "handling.backward_again",
            "handling.struggle_duration",
        ),
        occasion="dribble",
    ),
    Rule(
        "not_rolling",
        not_rolling.judge,
        ("fouls.not_rolling", "handling.roll_distance", "handling.roll_duration", "handling.roll_pause"),
        occasion="dribble",
    ),
    Rule("long_hold", long_hold.judge, ("fouls.long_hold", "handling.hold_duration"), occasion="dribble"),
    Rule(
        "charging",
        charging.judge,
        (
            "fouls.charging",
            "contact.charge_speed",
            "contact.charge_margin",
            "contact.charge_ball",
            "contact.charge_card_speed",
        ),
        occasion="impacts",
    ),
    Rule("pushing", pushing.judge, ("fouls.pushing", "contact.push_distance"), occasion="pushes"),
    Rule(
        "goal_area",
        goal_area.judge,
        ("fouls.goal_area", "areas.goal_area_duration"),
        occasion="stays",
    ),
    Rule(
        "penalty_area",
        penalty_area.judge,
        (
            "fouls.penalty_area",
            "areas.penalty_area_robots",
            "areas.penalty_area_duration",
            "areas.penalty_area_stay",
        ),
        occasion="stays",
    ),
    Rule(
        "leaving_field",
        leaving_field.judge,
        ("fouls.leaving_field", "contact.outside_duration"),
        occasion="outside",
    ),
    Rule("stand_off", stand_off.judge, ("contact.stand_off_duration",), occasion="pushes"),
    Rule("scrum", scrum.judge, ("scrum.reach", "scrum.progress", "scrum.duration"), occasion="contest"),
    Rule("stall", stall.judge, ("stall.still_speed", "stall.still_duration"), occasion="still ball"),
    Rule(
        "no_progress",
        no_progress.judge,
        ("stall.progress_distance", "stall.progress_duration"),
        occasion="no progress",
    ),
    Rule("half_end", half_end.judge, ("periods.halves", "periods.half_duration"), while_running=False),
)

SHOOT_OUT: tuple[Rule, ...] = (
    Rule("penalty_kick", penalty_kick.judge, PENALTY),
    Rule("shoot_out", shoot_out.judge, ("periods.shoot_out_limit",)),
)
"""The rules of the penalty shoot-out."""
RULES_BY_TIME: Mapping[str, tuple[Rule, ...]] = {
    "running": RULES,
    "halted": tuple(rule for rule in RULES if not rule.while_running),
    "shoot-out": SHOOT_OUT,
}
"""The rules that judge after START, while the game is halted or people officiate, and in a shoot-out."""


def first_decision(situation: Situation, *, clocks_alone: bool = False) -> tuple[Rule, Decision] | None:
    """The first rule that decides in this tick, with its decision."""
    for rule in rules_to_ask(situation, clocks_alone=clocks_alone):
        decision = rule.judge(situation)
        if decision is not None and not _is_noted(situation, rule, decision):
            return rule, decision
    return None


def _is_noted(situation: Situation, rule: Rule, decision: Decision) -> bool:
    """Whether a foul goes on that an advantage is played for."""
    noted = situation.state.advantage
    return noted is not None and noted.rule == rule.name and noted.decision.robot == decision.robot


def rules_to_ask(situation: Situation, *, clocks_alone: bool = False) -> tuple[Rule, ...]:
    """The rules that have anything to judge in this tick, in their order."""
    return _rules_for(_time(situation, clocks_alone), _occasions(situation))


OCCASIONS = (
    "set piece",
    "crossing",
    "kick",
    "dribble",
    "impacts",
    "pushes",
    "stays",
    "outside",
    "contest",
    "still ball",
    "no progress",
)
"""The occasions that rules depend on, in the order of `_occasions`."""


def _occasions(situation: Situation) -> tuple[bool, ...]:
    """Which of `OCCASIONS` are present in this tick."""
    state = situation.state
    seen = state.evidence
    return (
        state.set_piece is not None,
        situation.crossing is not None,
        seen.flight is not None,
        seen.dribble is not None,
        bool(situation.snapshot.impacts),
        bool(seen.pushes),
        seen.stays is not NO_STAYS,
        bool(seen.outside),
        seen.contest is not None,
        state.still > 0.0,
        no_progress.is_due(situation),
    )


@cache
def _rules_for(time: str, there: tuple[bool, ...]) -> tuple[Rule, ...]:
    """The rules of this time that may have anything to judge."""
    occasions = {"always", *compress(OCCASIONS, there)}
    return tuple([rule for rule in RULES_BY_TIME[time] if rule.occasion in occasions])


def _time(situation: Situation, clocks_alone: bool) -> str:
    if clocks_alone or not situation.state.running:
        return "halted"
    return "shoot-out" if situation.state.stage is GameStage.SHOOT_OUT else "running"
