"""Estimates on constructed results, whose truth is known."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

pytest.importorskip("scipy", reason="experiments need the extra study")
pd = pytest.importorskip("pandas", reason="experiments need the extra study")

from touchline.matches.statistics.paired import Comparison, adjusted, estimate_of, seed_means, widest  # noqa: E402
from touchline.matches.study.comparisons import answers, compared, comparison_groups, unread_factors  # noqa: E402
from touchline.matches.study.sentences import sentence_of, sentence_of_unread  # noqa: E402
from touchline.matches.study.study_plan import StudyPlan  # noqa: E402

MakePlan = Callable[[str], StudyPlan]
MakeTable = Callable[..., Any]
TWO_LEVELS = 'both_sides = false\nresponses = ["goals"]\n[factors]\nradio.loss = [0, 0.4]'
REPETITIONS = 200


def goals_of(plan: StudyPlan, results: Any) -> list[Comparison]:
    """What a study answers about goals."""
    return answers(compared(plan, results)["goals"])


def test_intervals_of_paired_differences_cover_the_truth_in_95_percent_of_200_studies(
    bare_plan: MakePlan, table: MakeTable
) -> None:
    plan, rng, effect = bare_plan(TWO_LEVELS), np.random.default_rng(18), 0.7
    covered = 0
    for _ in range(REPETITIONS):
        shared = rng.normal(3.0, 2.0, 12)  # what the seed does to both cells
        second = shared + effect + rng.normal(0.0, 1.0, 12)
        (found,) = goals_of(plan, table("goals", {1: shared, 2: second}))
        assert found.estimate.low is not None
        assert found.estimate.high is not None
        covered += found.estimate.low <= effect <= found.estimate.high
    assert 0.91 <= covered / REPETITIONS <= 0.985  # three standard deviations about 0.95


def test_intervals_of_means_of_goals_cover_the_truth_in_95_percent_of_200_studies() -> None:
    rng = np.random.default_rng(7)
    estimates = [estimate_of(pd.Series(rng.poisson(2.5, 25))) for _ in range(REPETITIONS)]
    covered = sum(one.low is not None and one.high is not None and one.low <= 2.5 <= one.high for one in estimates)
    assert 0.91 <= covered / REPETITIONS <= 0.985


def test_without_an_effect_one_comparison_in_twenty_leaves_0_out(bare_plan: MakePlan, table: MakeTable) -> None:
    plan, rng = bare_plan(TWO_LEVELS), np.random.default_rng(3)
    found = [
        goals_of(plan, table("goals", {1: rng.poisson(2, 15), 2: rng.poisson(2, 15)}))[0] for _ in range(REPETITIONS)
    ]
    assert sum(one.estimate.contains_zero is False for one in found) / REPETITIONS <= 0.09


def test_the_same_seeds_in_each_cell_show_an_effect_that_independent_samples_hide(
    bare_plan: MakePlan, table: MakeTable
) -> None:
    seeds = [0.0, 10.0, 20.0, 30.0, 40.0]
    lower = [value - 1.0 + wobble for value, wobble in zip(seeds, (0.1, -0.1, 0.0, 0.2, -0.2), strict=True)]
    (found,) = goals_of(bare_plan(TWO_LEVELS), table("goals", {1: seeds, 2: lower}))
    assert found.estimate.contains_zero is False
    assert found.effect_size is not None
    assert found.effect_size < -5
    assert sentence_of(found, "goals") == (
        "Goals: 1 less (95 % interval 0.804 to 1.2) with radio.loss = 0.4 than with radio.loss = 0, from 10 matches."
    )


def test_an_interval_with_0_is_said_with_both_its_ends_and_shows_nothing(bare_plan: MakePlan, table: MakeTable) -> None:
    values = {1: [1, 2, 0, 1, 3, 2], 2: [2, 1, 1, 0, 3, 2]}
    (found,) = goals_of(bare_plan(TWO_LEVELS), table("goals", values))
    assert sentence_of(found, "goals") == (
        "Goals: between 0.939 less and 0.939 more with radio.loss = 0.4 than with radio.loss = 0 "
        "(95 % interval, 12 matches); these matches do not show whether there is a difference."
    )


def test_a_difference_that_the_adjusted_p_does_not_support_is_no_finding(bare_plan: MakePlan, table: MakeTable) -> None:
    """One interval of six leaves 0 out, as one in twenty does without any effect."""
    names = ["goals", "shots", "fouls", "passes", "saves", "cards"]
    plan = bare_plan(TWO_LEVELS.replace('["goals"]', str(names)))
    results = table("goals", {1: [4, 4, 5, 3], 2: [2, 1, 4, 1]})
    for place, name in enumerate(names[1:]):
        results[name] = table(name, {1: [1, 2, 3, place], 2: [2, 1, 3, 1 + place % 2]})[name]
    (found,) = goals_of(plan, results)
    assert found.estimate.contains_zero is False and not found.is_found
    text = sentence_of(found, "goals")
    assert "between 3.3 less and 0.701 less" in text and "this does not show a difference (adjusted p 0.0977)" in text


def test_a_factor_that_changes_no_match_is_named(bare_plan: MakePlan) -> None:
    plan = bare_plan("both_sides = false\n[factors]\nradio.loss = [0, 0.4]\nteams.cyan.parameters.range = [1, 2]")
    rows = [(cell, seed, False, f"{seed} {(cell - 1) // 2}") for seed in (1, 2) for cell in (1, 2, 3, 4)]
    results = pd.DataFrame(rows, columns=["cell", "seed", "swapped", "chain"])
    assert unread_factors(plan, results) == ["teams.cyan.parameters.range"]
    assert sentence_of_unread("range") == (
        "range: all matches are equal to the byte at each of its levels; does the team read it?"
    )
    results.loc[0, "chain"] = "another"
    assert unread_factors(plan, results) == []


def test_equal_values_in_all_seeds_give_no_interval_and_no_warning(bare_plan: MakePlan, table: MakeTable) -> None:
    (found,) = goals_of(bare_plan(TWO_LEVELS), table("goals", {1: [2, 2, 2], 2: [2, 2, 2]}))
    assert (found.estimate.low, found.p, found.effect_size) == (None, None, None)
    assert "no difference" in sentence_of(found, "goals")
    (rounded,) = goals_of(bare_plan(TWO_LEVELS), table("goals", {1: [0.35, 0.45, 1.3], 2: [1.35, 1.45, 2.3]}))
    assert "the same difference, 1, between" in sentence_of(rounded, "goals")


def test_a_seed_that_failed_in_one_cell_is_left_out_of_the_pairs(bare_plan: MakePlan, table: MakeTable) -> None:
    (found,) = goals_of(bare_plan(TWO_LEVELS), table("goals", {1: [1, 2, 3, 9], 2: [2, 3, 5, None]}))
    assert (found.estimate.seeds, found.matches) == (3, 6)


def test_where_no_match_of_the_first_cell_ended_the_others_are_compared_with_the_next(
    bare_plan: MakePlan, table: MakeTable
) -> None:
    plan = bare_plan(TWO_LEVELS.replace("[0, 0.4]", "[0, 0.2, 0.4]"))
    (group,) = comparison_groups(plan, table("goals", {2: [1, 2, 3], 3: [2, 3, 5]}), "goals")
    assert group.title == "Cells, against radio.loss = 0.2"


def test_both_sides_of_a_seed_count_as_one_sample(bare_plan: MakePlan) -> None:
    plan = bare_plan('both_sides = true\nresponses = ["goals"]')
    rows = [(1, 1, False, 4), (1, 1, True, 2), (1, 2, False, 1), (1, 2, True, 0), (1, 3, False, 7)]
    table = pd.DataFrame(rows, columns=["cell", "seed", "swapped", "goals"])
    means = seed_means(table, "goals", plan.study.matches_of_seed)
    assert means[1].tolist()[:2] == [3.0, 0.5]
    assert pd.isna(means[1].tolist()[2])


def test_a_main_effect_is_averaged_over_the_other_factors(bare_plan: MakePlan, table: MakeTable) -> None:
    plan = bare_plan("both_sides = false\n[factors]\nradio.loss = [0, 0.4]\nradio.delay = [0.1, 0.5]")
    values = {1: [10, 11, 12], 2: [20, 22, 21], 3: [8, 9, 11], 4: [16, 18, 18]}
    loss, delay, cells = comparison_groups(plan, table("goals", values), "goals")
    assert [one.label for one in loss.comparisons] == ["radio.loss = 0.4"]
    assert loss.comparisons[0].estimate.value == pytest.approx((-3.0 - 3.0 - 2.0) / 3)
    assert delay.comparisons[0].estimate.value == pytest.approx((9.0 + 10.0 + 8.0) / 3)
    assert loss.is_answer
    assert not cells.is_answer
    assert len(cells.comparisons) == 3


def test_p_values_are_adjusted_for_their_number(bare_plan: MakePlan, table: MakeTable) -> None:
    plan = bare_plan("both_sides = false\n[factors]\nradio.loss = [0, 0.2, 0.4]")
    found = goals_of(plan, table("goals", {1: [1, 2, 3, 2], 2: [2, 3, 4, 4], 3: [1, 3, 3, 1]}))
    assert all(one.adjusted_p is not None and one.p is not None and one.adjusted_p >= one.p for one in adjusted(found))


def test_an_interval_is_narrow_once_seeds_suffice(table: MakeTable) -> None:
    rng = np.random.default_rng(1)
    few, many = (table("goals", {1: rng.normal(0, 1, n), 2: rng.normal(0, 1, n)}) for n in (4, 400))
    assert widest(few, "goals", 1) > 0.5 > widest(many, "goals", 1)
    assert widest(table("goals", {1: [1, 1], 2: [1, 1]}), "goals", 1) is None
