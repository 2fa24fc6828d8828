"""An exception of a brain in one line."""

import pytest

from robot_agent.loading.user_code import sentence_of


class _Team:
    def __init__(self) -> None:
        self.count = 0


def _misspelt_attribute() -> None:
    _Team().cuont  # type: ignore[attr-defined]  # noqa: B018


def _misspelt_name() -> None:
    count = 0
    cuont, count  # type: ignore[name-defined]  # noqa: B018, F821


def _in_lines() -> None:
    raise ValueError("no plan\n  for 3 robots")


@pytest.mark.parametrize(
    ("act", "sentence"),
    [
        (_misspelt_attribute, "AttributeError: '_Team' object has no attribute 'cuont'. Did you mean: 'count'?"),
        (_misspelt_name, "NameError: name 'cuont' is not defined. Did you mean: 'count'?"),
        (_in_lines, "ValueError: no plan for 3 robots"),
    ],
)
def test_an_exception_is_one_line_with_the_name_that_python_suggests(act, sentence) -> None:
    with pytest.raises(Exception) as raised:
        act()
    assert sentence_of(raised.value) == sentence
