"""What happens in a scene, on ticks made by hand."""

import pytest

from recordings.soccer.stats.match_tick import match_ticks
from schemas.side import Side
from schemas.soccer.game import EventKind, Score
from support.match_script import MatchScript
from touchline.matches.judging.occurrences import Occurrence, OccurrenceTracker


@pytest.fixture
def script() -> MatchScript:
    return MatchScript()


def names(script: MatchScript) -> list[tuple[str, str | None]]:
    tracker, found = OccurrenceTracker(script.setup), []
    for tick in match_ticks(script.setup, script.messages):
        found += tracker.update(tick)
    return [(one.name, one.robot or one.side) for one in [*found, *tracker.end()]]


def test_a_touch_counts_when_it_begins(script: MatchScript) -> None:
    script.shot(touches=["cyan2"])
    script.shot(touches=["cyan2"])
    script.shot()
    script.shot(touches=["cyan2", "magenta2"])
    assert names(script) == [("touch", "cyan2"), ("touch", "cyan2"), ("touch", "magenta2")]


def test_the_ball_is_held_from_the_tick_in_which_a_robot_gets_it(script: MatchScript) -> None:
    script.held_by = "cyan2"
    script.shot()
    script.shot()
    script.held_by = None
    script.shot()
    script.held_by = "magenta2"
    script.shot()
    assert names(script) == [("held_by", "cyan2"), ("held_by", "magenta2")]


def test_a_goal_belongs_to_its_side_and_to_a_scorer_of_that_side(script: MatchScript) -> None:
    script.shot(events=[{"kind": EventKind.GOAL, "side": Side.CYAN, "robot": "cyan2"}], score=Score(cyan=1))
    script.shot(events=[{"kind": EventKind.GOAL, "side": Side.CYAN, "robot": "magenta2"}], score=Score(cyan=2))
    assert names(script) == [("goal", "cyan2"), ("goal", Side.CYAN)]


def test_a_kick_that_a_teammate_receives_is_a_pass(script: MatchScript) -> None:
    script.shot(touches=["cyan2"], kicked="cyan2", speed=(-4.0, 0.0, 0.0))
    script.ball = (-4.0, 0.0)
    script.shot()
    script.shot(touches=["cyan1"])
    assert names(script) == [("touch", "cyan2"), ("kick", "cyan2"), ("touch", "cyan1"), ("pass", "cyan2")]


@pytest.mark.parametrize(
    ("occurred", "meant"),
    [("touch", True), ("touch:cyan2", True), ("touch:cyan", True), ("touch:magenta", False), ("kick:cyan2", False)],
)
def test_a_condition_means_anybody_a_side_or_a_robot(occurred: str, meant: bool) -> None:
    assert Occurrence("touch", 1.0, "cyan2", Side.CYAN).is_meant_by(occurred) is meant
