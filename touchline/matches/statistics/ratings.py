"""Ratings: the strength of each team from all matches, with intervals (Bradley and Terry; draws after Davidson).

A team of strength θ beats one of strength φ with a probability in proportion to exp θ, loses in proportion to exp φ,
and draws in proportion to ν exp((θ + φ) / 2). A weak prior keeps the strength of a team that has won all its matches
finite. The scale is Elo's: 400 points are odds of ten to one, and the mean of all teams is 0.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize
from scipy.special import chdtrc, ndtri

from touchline.matches.statistics.estimates import LEVEL

SCALE = 400 / math.log(10)
"""Elo points of one unit of strength."""
PRIOR = 3.0
"""Standard deviation of the prior of strengths and of ln ν: ± 1,000 points for 95 % of teams."""


Array = npt.NDArray[np.float64]


class Scored(NamedTuple):
    """The goals of a match, in the order of its teams."""

    teams: tuple[str, str]
    goals: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Rating:
    """The strength of a team, in Elo points relative to the mean of all teams."""

    team: str
    value: float
    low: float
    high: float
    matches: int
    """Matches that it is estimated from."""


@dataclass(frozen=True, slots=True)
class RankComparison:
    """Whether a team is stronger than the next one."""

    stronger: str
    weaker: str
    difference: float
    """Elo points."""
    p: float
    """Probability of so great a difference, in either direction, between teams of equal strength; corrected after
    Holm for the number of comparisons."""
    significant: bool


@dataclass(frozen=True, slots=True)
class Ratings:
    """The ratings of all teams, best first."""

    teams: tuple[Rating, ...]
    order: tuple[RankComparison, ...]
    """Each team against the next one."""

    @property
    def significant(self) -> bool:
        """Whether the whole order is significant: each team is stronger than the next one."""
        return all(one.significant for one in self.order)


def rate(teams: Sequence[str], played: Sequence[Scored], level: float = LEVEL) -> Ratings:
    """Ratings from the goals of all matches that were played; a shoot-out counts as a draw."""
    model = _Model(teams, played)
    x, least = model.fit(np.eye(len(teams) + 1))
    centring = np.eye(len(teams)) - 1 / len(teams)
    values = centring @ x[:-1]
    covariance = centring @ np.linalg.inv(model.information(x))[:-1, :-1] @ centring.T
    order = sorted(range(len(teams)), key=lambda place: (-round(float(values[place]), 6), teams[place]))
    z = float(ndtri((1 + level) / 2))

    def rating(place: int) -> Rating:
        half = z * math.sqrt(max(0.0, covariance[place, place]))
        low, value, high = (SCALE * (float(values[place]) + one * half) for one in (-1, 0, 1))
        return Rating(teams[place], value, low, high, sum(teams[place] in one.teams for one in played))

    pairs = list(pairwise(order))
    corrected = holm([model.probability_of_equality(above, below, least) for above, below in pairs])
    comparisons = (
        RankComparison(teams[above], teams[below], SCALE * float(values[above] - values[below]), p, p < 1 - level)
        for (above, below), p in zip(pairs, corrected, strict=True)
    )
    return Ratings(tuple(rating(place) for place in order), tuple(comparisons))


def holm(probabilities: Sequence[float]) -> list[float]:
    """Holm's correction: probabilities that may be compared with one level, however many there are."""
    order = np.argsort(probabilities)
    raised = np.minimum(1.0, np.sort(probabilities) * np.arange(len(order), 0, -1))
    return [float(one) for one in np.maximum.accumulate(raised)[np.argsort(order)]]


class _Model:
    """The likelihood of all matches as a function of x: the strengths of the teams, and ln ν."""

    def __init__(self, teams: Sequence[str], results: Sequence[Scored]) -> None:
        place = {team: number for number, team in enumerate(teams)}
        self._rows = np.zeros((len(results), 3, len(teams) + 1))
        """For each match the logits of win, draw and loss, linear in x."""
        self._came_true = np.zeros(len(results), dtype=np.int64), np.zeros(len(results), dtype=np.int64)
        for number, one in enumerate(results):
            first, second = (place[team] for team in one.teams)
            self._rows[number, 0, first] = self._rows[number, 2, second] = 1.0
            self._rows[number, 1, [first, second]] = 0.5
            self._rows[number, 1, -1] = 1.0
            outcome = 0 if one.goals[0] > one.goals[1] else 1 if one.goals[0] == one.goals[1] else 2
            self._came_true[0][number], self._came_true[1][number] = number, outcome

    def fit(self, subspace: Array) -> tuple[Array, float]:
        """The x of least loss among the combinations of the columns of `subspace`, and that loss."""

        def loss(y: Array) -> tuple[float, Array]:
            value, gradient = self._loss(subspace @ y)
            return value, subspace.T @ gradient

        found = minimize(loss, np.zeros(subspace.shape[1]), jac=True, method="BFGS", options={"gtol": 1e-6})
        return subspace @ found.x, float(found.fun)

    def probability_of_equality(self, above: int, below: int, least: float) -> float:
        """Probability of so good a fit between two teams of equal strength (likelihood-ratio test).

        Wald's test fails where a team has won all its matches: its standard error grows with the difference.
        """
        equal = np.eye(self._rows.shape[2])
        equal[:, above] += equal[:, below]
        _, loss = self.fit(np.delete(equal, below, axis=1))
        return float(chdtrc(1, max(0.0, 2 * (loss - least))))

    def information(self, x: Array) -> Array:
        """The second derivatives of the loss: the inverse of the covariance."""
        shares, _ = self._shares(x)
        means = np.einsum("mk,mkp->mp", shares, self._rows)
        squares = np.einsum("mk,mkp,mkq->pq", shares, self._rows, self._rows)
        return np.asarray(squares - means.T @ means + np.eye(len(x)) / PRIOR**2)

    def _loss(self, x: Array) -> tuple[float, Array]:
        """Minus the logarithm of likelihood times prior, and its gradient."""
        shares, logarithms = self._shares(x)
        gradient = x / PRIOR**2 + np.einsum("mk,mkp->p", shares, self._rows) - self._rows[self._came_true].sum(axis=0)
        return float(x @ x / (2 * PRIOR**2) - logarithms[self._came_true].sum()), gradient

    def _shares(self, x: Array) -> tuple[Array, Array]:
        """Probabilities of win, draw and loss of each match, and their logarithms."""
        logits = self._rows @ x
        logits = logits - logits.max(axis=1, keepdims=True)
        logarithms = np.asarray(logits - np.log(np.exp(logits).sum(axis=1, keepdims=True)))
        return np.exp(logarithms), logarithms
