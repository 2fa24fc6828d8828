"""Verdicts of drills."""

import pytest

from schemas.config.scene import load_scene, shipped_scenes
from schemas.config.soccer.drill import OCCURRENCES, Drill, DrillResult
from schemas.side import Side
from touchline.matches.judging.judge import DrillVerdict, verdict_of
from touchline.matches.judging.occurrences import Occurrence

DRILL = Drill(seconds=5.0, success=["goal:cyan"], failure=["ball_out", "held_by:magenta"])
GOAL = Occurrence("goal", 2.0, "cyan2", Side.CYAN)
OUT = Occurrence("ball_out", 2.0)


def test_a_drill_goes_on_while_no_condition_is_met() -> None:
    assert verdict_of(DRILL, 2.0, [Occurrence("kick", 2.0, "cyan2", Side.CYAN)]) is None
    assert verdict_of(DRILL, 2.0, [Occurrence("goal", 2.0, None, Side.MAGENTA)]) is None


def test_the_first_condition_that_is_met_decides() -> None:
    assert verdict_of(DRILL, 2.0, [GOAL]) == DrillVerdict(True, "goal:cyan", 2.0)
    assert verdict_of(DRILL, 2.0, [OUT]) == DrillVerdict(False, "ball_out", 2.0)


def test_a_failure_in_the_same_tick_comes_before_a_success() -> None:
    assert verdict_of(DRILL, 2.0, [GOAL, OUT]) == DrillVerdict(False, "ball_out", 2.0)


@pytest.mark.parametrize(("otherwise", "success"), [(DrillResult.FAILURE, False), (DrillResult.SUCCESS, True)])
def test_the_verdict_after_its_time_is_that_of_the_scene(otherwise: DrillResult, success: bool) -> None:
    drill = DRILL.model_copy(update={"otherwise": otherwise})
    assert verdict_of(drill, 4.98, []) is None
    assert verdict_of(drill, 5.0, []) == DrillVerdict(success, "none of the conditions", 5.0)


def test_shipped_drills_can_succeed_and_fail() -> None:
    drills = {name: drill for name in shipped_scenes() if (drill := load_scene(name).drill) is not None}
    assert {"one_against_keeper", "keeper_lobs", "intercept_pass", "receive_pass", "throw_in", "corner"} <= set(drills)
    for name, drill in drills.items():
        assert drill.success or drill.otherwise is DrillResult.SUCCESS, name
        assert drill.failure or drill.otherwise is DrillResult.FAILURE, name


def test_every_occurrence_is_described() -> None:
    assert all(OCCURRENCES.values())
