"""Touches of the ball in one physics step: by force, level where forces are equal, never by the order of the roster."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim_host.soccer.ball.touches import by_force

TIE = 0.1
FORCES = st.dictionaries(st.integers(0, 9), st.floats(0.0, 1e3), max_size=4)
HOLDERS = st.none() | st.integers(0, 9)


@pytest.mark.parametrize(
    ("forces", "holder", "robots", "level"),
    [
        ({}, None, [], ()),
        ({3: 5.0}, None, [3], ()),
        ({3: 0.0}, None, [], ()),
        ({}, 3, [3], ()),
        ({1: 9.0, 6: 5.0}, None, [6, 1], ()),
        ({1: 5.0, 6: 9.0}, None, [1, 6], ()),
        ({1: 0.0, 6: 9.0}, 1, [1, 6], ()),
        ({6: 9.0}, 1, [1, 6], ()),
        ({1: 12.0, 6: 9.0}, 1, [6, 1], ()),
        ({1: 9.1, 6: 10.0}, None, [1, 6], (1, 6)),
        ({1: 8.9, 6: 10.0}, None, [1, 6], ()),
        ({1: 2.0, 6: 10.0, 7: 9.5}, None, [1, 7, 6], (7, 6)),
    ],
    ids=str,
)
def test_the_harder_press_is_the_later_touch_and_equal_presses_are_level(forces, holder, robots, level) -> None:
    assert by_force(forces, holder, TIE) == (robots, level)


@given(FORCES, HOLDERS, st.permutations(range(10)))
def test_robots_that_change_places_in_the_roster_change_places_in_the_touches(forces, holder, places) -> None:
    """Of equally hard presses the order is arbitrary, and they are level."""
    one = by_force(forces, holder, TIE)
    renamed = {places[robot]: force for robot, force in sorted(forces.items(), key=lambda item: places[item[0]])}
    other = by_force(renamed, None if holder is None else places[holder], TIE)
    assert {places[robot] for robot in one.level} == set(other.level)
    if not one.level:
        assert [places[robot] for robot in one.robots][-1:] == other.robots[-1:]
    assert {places[robot] for robot in one.robots} == set(other.robots)


@given(FORCES, HOLDERS)
def test_the_level_robots_are_the_last_of_the_touches(forces, holder) -> None:
    touches = by_force(forces, holder, TIE)
    assert len(touches.level) != 1
    assert list(touches.level) == touches.robots[len(touches.robots) - len(touches.level) :]
