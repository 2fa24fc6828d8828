"""Dribbles: ways with the ball in hand."""

import pytest
from pytest import approx

from schemas.game import Phase


def carry(film, metres: float, robot: str = "cyan2") -> None:
    film.held_by = robot
    film.shot(touches=[robot])
    for _ in range(round(metres / 0.1)):
        x, y = film.places[robot]
        film.places[robot] = (x + 0.1, y)
        film.shot(touches=[robot])


def of(film, robot: str = "cyan2"):
    one = next(one for one in film.figures().robots if one.name == robot)
    return one.dribbles, one.dribbled, one.longest_dribble


def test_a_dribble_is_a_metre_with_the_ball_at_least(film) -> None:
    carry(film, 0.8)
    film.held_by = None
    film.rest(10)
    assert of(film) == (0, 0.0, 0.0)
    carry(film, 1.5)
    film.held_by = None
    film.rest(10)
    carry(film, 2.0)
    assert of(film) == (2, approx(3.5), approx(2.0))


@pytest.mark.parametrize(("gap", "count"), [(3, 1), (8, 2)])
def test_a_hold_that_flickers_is_one_dribble(film, gap: int, count: int) -> None:
    carry(film, 1.5)
    film.held_by = None
    film.rest(gap)
    carry(film, 1.5)
    assert of(film)[0] == count


def test_a_touch_of_another_a_kick_and_a_stop_end_a_dribble(film) -> None:
    ends = (
        {"touches": ["magenta2"]},
        {"touches": ["cyan2"], "kicked": "cyan2"},
        {"phase": Phase.STOPPED, "running": False},
    )
    for end in ends:
        film.shot(phase=Phase.PLAY, running=True)
        film.rest(1)
        carry(film, 1.2)
        film.held_by = None
        film.shot(**end)
    film.shot(phase=Phase.PLAY, running=True)
    carry(film, 0.6)
    assert of(film) == (3, approx(3.6), approx(1.2))
