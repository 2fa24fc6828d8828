"""What a comparison shows, in one sentence that promises no more than the matches support."""

import math

from touchline.matches.statistics.paired import Comparison
from touchline.matches.study.match_figures import DIFFERENCE

UNKNOWN = "–"


def sentence_of(comparison: Comparison, response: str) -> str:
    """The result of a comparison; where the interval contains 0, the largest difference that it leaves possible."""
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
    if one.contains_zero:
        most = rounded_up(max(-one.low, one.high))
        return f"{name}: no difference of more than {most} {between} can be told from {matches}."
    more = "more" if one.value > 0 else "less"
    low, high = sorted((abs(one.low), abs(one.high)))
    return (
        f"{name}: {number(abs(one.value))} {more} (95 % interval {number(low)} to {number(high)}) "
        f"with {comparison.label} than with {comparison.reference}, from {matches}."
    )


def response_text(response: str) -> str:
    """The name of a response as words."""
    text = response.removesuffix(DIFFERENCE)
    text = (f"{text} (first team − second)" if text != response else text).replace("_", " ")
    return f"{text[:1].upper()}{text[1:]}".replace(".", " ")


def number(value: float | None) -> str:
    """Three significant digits."""
    return UNKNOWN if value is None or math.isnan(value) else f"{value:.3g}"


def rounded_up(value: float) -> str:
    """Two significant digits, never less than the value: a bound."""
    if value == 0:
        return "0"
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(round(value / unit, 9)) * unit:.2g}"
