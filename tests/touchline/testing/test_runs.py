"""Assertions on many seeds, on facts made by hand."""

import numpy as np
import pytest

from schemas.config.profile import load_profile
from schemas.side import Side
from schemas.soccer.game import Score
from touchline.matches.judging.occurrences import Occurrence
from touchline.testing import Facts, Runs


def facts(seed: int, shot_after: float | None) -> Facts:
    shots = [Occurrence("shot", shot_after, "cyan2", Side.CYAN)] if shot_after is not None else []
    return Facts(
        scene="alone",
        seed=seed,
        verdict=None,
        score=Score(),
        pitch=load_profile("msl").field,
        events=[],
        occurrences=shots,
        kicks=[],
        times=np.array([0.0, 6.0]),
        ball=np.zeros((2, 3)),
        robots={"cyan2": np.zeros((2, 3))},
        commands={},
    )


RUNS = Runs([facts(1, 2.0), facts(2, 3.5), facts(3, None), facts(4, 5.2)])


def quick(one: Facts) -> bool:
    return one.first("shot").time < 4


def test_conditions_are_counted_over_the_seeds() -> None:
    assert (len(RUNS), RUNS.count(quick), RUNS.count(lambda one: one.has("shot"))) == (4, 2, 3)
    RUNS.at_least(2, quick)
    RUNS.at_most(2, quick)
    RUNS.always(lambda one: not one.has("goal"))
    RUNS.never(lambda one: one.has("goal"))


def test_too_few_are_reported_with_what_happened_in_the_others() -> None:
    with pytest.raises(AssertionError) as error:
        RUNS.at_least(3, quick)
    assert str(error.value).splitlines() == [
        "2 of 4 seeds, at least 3 wanted; not these:",
        "  no shot in 6.0 s of alone, seed 3: nothing happened",
        "  alone, seed 4: shot:cyan2 after 5.2 s",
    ]


def test_too_many_are_reported_with_what_happened_in_them() -> None:
    with pytest.raises(AssertionError) as error:
        RUNS.never(quick)
    assert str(error.value).splitlines() == [
        "2 of 4 seeds, none wanted; these:",
        "  alone, seed 1: shot:cyan2 after 2.0 s",
        "  alone, seed 2: shot:cyan2 after 3.5 s",
    ]
    with pytest.raises(AssertionError, match="2 of 4 seeds, at most 1 wanted"):
        RUNS.at_most(1, quick)
    with pytest.raises(AssertionError, match="2 of 4 seeds, all wanted"):
        RUNS.always(quick)


def test_a_message_describes_a_few_of_many_seeds() -> None:
    many = Runs([facts(seed, None) for seed in range(20)])
    with pytest.raises(AssertionError) as error:
        many.always(quick)
    assert len(str(error.value).splitlines()) == 7
    assert str(error.value).endswith("  and 15 more")


def test_no_seeds_are_no_success() -> None:
    with pytest.raises(AssertionError, match="no seed was played"):
        Runs([]).always(quick)


def test_other_exceptions_of_a_condition_are_not_swallowed() -> None:
    with pytest.raises(ZeroDivisionError):
        RUNS.always(lambda one: 1 / 0)
