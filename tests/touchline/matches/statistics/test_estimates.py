"""Estimates and their intervals, against published values."""

import math

import pytest
from pytest import approx

from touchline.matches.statistics.estimates import mean, ratio, share, student_t


@pytest.mark.parametrize(("freedom", "t"), [(1, 12.706), (2, 4.303), (3, 3.182), (9, 2.262), (30, 2.042), (100, 1.984)])
def test_quantiles_of_student_are_those_of_the_tables(freedom: int, t: float) -> None:
    assert student_t(freedom) == approx(t, abs=5e-4)


def test_the_interval_of_a_share_is_that_of_wilson() -> None:
    found = share(8, 10)
    assert found is not None
    assert (found.value, found.low, found.high) == (0.8, approx(0.4902, abs=1e-4), approx(0.9433, abs=1e-4))


def test_a_share_without_a_success_has_an_interval_from_0() -> None:
    found = share(0, 20)
    assert found is not None
    assert (found.value, found.low, found.high) == (0.0, 0.0, approx(0.1611, abs=1e-4))


def test_a_share_of_no_trials_is_unknown() -> None:
    assert share(0, 0) is None


def test_a_ratio_with_equal_sizes_has_the_interval_of_a_mean() -> None:
    found = ratio([2.0, 4.0, 6.0], [1.0, 1.0, 1.0])
    assert found is not None
    half = student_t(2) * 2.0 / math.sqrt(3)
    assert (found.value, found.low, found.high) == (4.0, 0.0, approx(4.0 + half))  # no count is below 0


def test_a_ratio_weighs_samples_by_their_size() -> None:
    found = ratio([1.0, 9.0], [1.0, 3.0])
    assert found is not None
    assert found.value == 2.5


def test_the_interval_of_a_share_ends_at_1() -> None:
    found = ratio([5.0, 1.0], [5.0, 2.0], most=1.0)
    assert found is not None
    assert found.high == 1.0


def test_one_sample_has_no_interval_and_no_time_no_value() -> None:
    found = ratio([3.0], [2.0])
    assert found is not None
    assert (found.value, found.low, found.high) == (1.5, None, None)
    assert ratio([0.0], [0.0]) is None


@pytest.mark.parametrize("counts", [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
def test_equal_ratios_have_no_interval(counts: list[float]) -> None:
    found = ratio(counts, [600.02, 1200.04, 1800.06])
    assert found is not None
    assert (found.value, found.low, found.high) == (approx(counts[0] / 600.02), None, None)


def test_a_mean_has_the_interval_of_student() -> None:
    found = mean([1.0, -2.0, 4.0])
    assert found is not None
    half = 4.303 * 3.0 / math.sqrt(3)
    assert (found.value, found.low, found.high) == (1.0, approx(1.0 - half, abs=1e-3), approx(1.0 + half, abs=1e-3))
    assert mean([]) is None and mean([2.0]).width is mean([2.0, 2.0]).width is None
