"""The score of goalkeeper: 1 unless the shooter scores."""

from schemas.soccer.game import Phase
from support.task_moment import scored


def test_a_goal_costs_the_point_and_ends_the_episode() -> None:
    conceded = scored("goalkeeper", goals=(0, 1), phase=Phase.STOPPED)
    assert (conceded.value, conceded.over) == (0.0, True)


def test_a_caught_ball_and_one_that_is_out_end_the_episode_with_the_point() -> None:
    for end in ({"holder": "cyan1"}, {"phase": Phase.STOPPED}):
        score = scored("goalkeeper", **end)
        assert (score.value, score.over) == (1.0, True)
    assert not scored("goalkeeper", holder="magenta1").over
