"""Selections of keys: key expressions mean what they mean on the bus."""

import pytest

from recordings.container.key_selection import KeySelection, matches
from schemas.errors import TouchlineError


@pytest.mark.parametrize(
    ("expression", "key", "meant"),
    [
        ("robot/*/command", "robot/cyan1/command", True),
        ("robot/*/command", "robot/a/b/command", False),
        ("team/**", "team/cyan/belief/cyan1", True),
        ("team/**", "teams", False),
        ("**/order", "order", True),
        ("**", "world", True),
        ("**/**", "world", True),
        ("team/**/cyan1", "team/cyan1", True),
        ("robot/cyan$*/command", "robot/cyan12/command", True),
        ("world", "world/ball", False),
    ],
)
def test_key_expressions_mean_what_they_mean_on_the_bus(expression, key, meant):
    assert matches(expression, key) is meant


@pytest.mark.parametrize("expression", ["", "a//b", "/a", "a/", "a*b", "a b", "a?"])
def test_what_is_no_key_expression_is_refused_with_an_example(expression):
    with pytest.raises(TouchlineError, match=r"not a key expression.*robot/\*/command"):
        KeySelection(include=(expression,))
