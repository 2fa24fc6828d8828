"""Seeds as they are written on a command line."""

import pytest

from schemas.errors import TouchlineError
from touchline.matches.series.seeds import seeds_of


@pytest.mark.parametrize(
    ("text", "seeds"),
    [
        ("7", [7]),
        ("99999-100001", [99_999, 100_000, 100_001]),
        ("1-4", [1, 2, 3, 4]),
        ("1-3,31, 40-41", [1, 2, 3, 31, 40, 41]),
        ("5,2", [5, 2]),
    ],
)
def test_ranges_and_single_seeds_are_read_in_their_order(text: str, seeds: list[int]) -> None:
    assert seeds_of(text) == seeds


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "write a range"),
        ("one", "write a range"),
        ("1..5", "write a range"),
        ("-3", "write a range"),
        ("9-1", "write 1-9"),
        ("1-3,2", "the seed 2 twice"),
        ("1-999999999", "more than 100000 seeds"),
        ("1-100000,100001", "more than 100000 seeds"),
    ],
)
def test_other_texts_are_refused_with_a_remedy(text: str, said: str) -> None:
    with pytest.raises(TouchlineError, match=said):
        seeds_of(text)
