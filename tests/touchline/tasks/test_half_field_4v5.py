"""The score of half_field_4v5: 1 for a goal, until the defenders have won the ball or it leaves the half."""

import pytest
from pytest import approx

from schemas.messages.soccer.game import GameState
from schemas.side import Side
from schemas.soccer.game import Phase
from support.task_moment import scored


def free_kick(side: Side) -> GameState:
    """The state of the game at a free kick of this side."""
    return GameState(tick=50, time=1.0, phase=Phase.FREE_KICK, side=side)


def test_a_goal_is_one_and_the_end_and_an_own_goal_none_and_the_end() -> None:
    for goals, value in (((1, 0), 1.0), ((0, 1), 0.0)):
        score = scored("half_field_4v5", goals=goals, phase=Phase.STOPPED)
        assert (score.value, score.over) == (value, True)


def test_a_defender_has_won_the_ball_once_it_has_held_it_for_three_seconds() -> None:
    free = scored("half_field_4v5", holder="cyan1", time=5.0)
    held = scored("half_field_4v5", memory=free.memory, holder="magenta2", time=7.9)
    assert not held.over
    assert scored("half_field_4v5", memory=held.memory, holder="magenta2", time=8.1).over
    again = scored("half_field_4v5", memory=held.memory, holder="cyan2", time=8.1)
    assert not scored("half_field_4v5", memory=again.memory, holder="magenta2", time=11.0).over


def test_a_restart_of_the_attackers_is_part_of_the_attack_and_one_of_the_defenders_its_end() -> None:
    assert not scored("half_field_4v5", phase=Phase.STOPPED, ball=(2.0, 7.6)).over
    assert not scored("half_field_4v5", game=free_kick(Side.CYAN)).over
    assert scored("half_field_4v5", game=free_kick(Side.MAGENTA)).over


@pytest.mark.parametrize(("x", "is_over"), [(-0.9, False), (-1.1, True)])
def test_a_ball_that_leaves_the_half_by_a_metre_ends_the_attack(x: float, is_over: bool) -> None:
    assert scored("half_field_4v5", ball=(x, 0.0)).over == is_over


def test_the_reward_is_a_goal_and_the_balls_way_to_it() -> None:
    start = scored("half_field_4v5", ball=(1.0, 0.0))
    assert start.reward == 0.0
    assert scored("half_field_4v5", memory=start.memory, ball=(6.0, 0.0)).reward == approx(0.1)
    assert scored("half_field_4v5", memory=start.memory, ball=(6.0, 0.0), goals=(1, 0)).reward == approx(1.1)
