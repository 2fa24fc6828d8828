"""What a comparison shows, in one sentence that promises no more than the matches support."""

import math
from collections.abc import Sequence
from difflib import get_close_matches

from touchline.matches.statistics.paired import Comparison
from touchline.matches.study.match_figures import DIFFERENCE

UNKNOWN = "–"


def sentence_of(comparison: Comparison, response: str) -> str:
    """The result of a comparison: a difference where the adjusted p shows one, otherwise what is possible."""
    one, name = comparison.estimate, response_text(response)
    between = f"between {comparison.label} and {comparison.reference}"
    matches = f"{comparison.matches} matches" if comparison.matches != 1 else "one match"
    if one.seeds == 0:
        return f"{name}: no seed was played both with {comparison.label} and with {comparison.reference}."
    if one.seeds == 1:
        return f"{name}: one seed gives no interval for a difference {between}; play more seeds."
    if one.low is None or one.high is None:
        how = f"the same difference, {number(one.value)}," if one.value else "no difference"
        return f"{name}: {how} {between} in all {one.seeds} seeds; without any variation there is no interval."
    versus = f"with {comparison.label} than with {comparison.reference}"
    if comparison.is_found:
        low, high = sorted((abs(one.low), abs(one.high)))
        interval = f"95 % interval {number(low)} to {number(high)}"
        return f"{name}: {_amount(one.value)} ({interval}) {versus}, from {matches}."
    shown = "these matches do not show whether there is a difference"
    if not one.contains_zero:
        shown = f"for so many comparisons this does not show a difference (adjusted p {number(comparison.adjusted_p)})"
    return f"{name}: between {_amount(one.low)} and {_amount(one.high)} {versus} (95 % interval, {matches}); {shown}."


def sentence_of_unread(key: str) -> str:
    """That a factor changes nothing."""
    return f"{key}: all matches are equal to the byte at each of its levels; does the team read it?"


def sentence_of_missing(response: str, known: Sequence[str]) -> str:
    """That no match has a figure of this name; `known` are the names of those that they have."""
    close = get_close_matches(response, known, n=1)
    remedy = f'did you mean "{close[0]}"?' if close else "the columns of the table of results are its names."
    return f"No match has a figure {response}; {remedy}"


def response_text(response: str) -> str:
    """The name of a response as words."""
    text = response.removesuffix(DIFFERENCE)
    text = (f"{text} (first team − second)" if text != response else text).replace("_", " ")
    return f"{text[:1].upper()}{text[1:]}".replace(".", " ")


def number(value: float | None) -> str:
    """Three significant digits."""
    return UNKNOWN if value is None or math.isnan(value) else f"{value:.3g}"


def _amount(difference: float) -> str:
    return f"{number(abs(difference))} {'more' if difference > 0 else 'less'}" if difference else "0"
