"""The scores of the soccer tasks that count goals: two_on_one, free_kick and full_match."""

import pytest

from schemas.messages.soccer.game import GameState
from schemas.soccer.game import Phase
from support.task_moment import scored


@pytest.mark.parametrize("task", ["two_on_one", "free_kick"])
def test_a_goal_of_the_attackers_is_one_and_the_end(task: str) -> None:
    won = scored(task, goals=(1, 0), phase=Phase.STOPPED)
    assert (won.value, won.over) == (1.0, True)
    conceded = scored(task, goals=(0, 1), phase=Phase.STOPPED)
    assert (conceded.value, conceded.over) == (0.0, True)


@pytest.mark.parametrize("task", ["two_on_one", "free_kick"])
def test_a_lost_ball_and_a_stop_of_play_are_the_end_without_a_goal(task: str) -> None:
    for end in ({"holder": "magenta1"}, {"phase": Phase.STOPPED}):
        score = scored(task, **end)
        assert (score.value, score.over) == (0.0, True)
    assert not scored(task, holder="cyan2").over


def test_the_free_kick_itself_is_part_of_the_episode() -> None:
    game = GameState(tick=50, time=1.0, phase=Phase.FREE_KICK, running=True)
    assert not scored("free_kick", game=game).over


def test_a_match_counts_the_difference_of_the_goals() -> None:
    assert scored("full_match", goals=(3, 1)).value == 2.0
    assert scored("full_match", goals=(0, 2)).value == -2.0
