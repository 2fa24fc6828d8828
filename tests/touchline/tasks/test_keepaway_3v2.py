"""The score of keepaway: the time for which the three keep the ball."""

import pytest

from schemas.soccer.game import Phase
from support.task_moment import scored


def test_the_score_is_the_time_while_a_keeper_or_nobody_has_the_ball() -> None:
    for holder in ("cyan2", None):
        score = scored("keepaway_3v2", holder=holder, time=7.5)
        assert (score.value, score.over) == (7.5, False)


@pytest.mark.parametrize(
    "loss",
    [{"holder": "magenta1"}, {"ball": (6.1, 0.0)}, {"ball": (0.0, -6.1)}, {"phase": Phase.STOPPED}],
    ids=["a taker", "beyond the square", "beside the square", "the referee"],
)
def test_it_ends_when_the_ball_is_taken_or_leaves_the_square_or_play_stops(loss) -> None:
    score = scored("keepaway_3v2", time=7.5, **loss)
    assert (score.value, score.over) == (7.5, True)
