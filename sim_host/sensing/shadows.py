"""Finds the hulls that may cross a line of sight by bearing, since most of many hulls are near few lines.

Seen from an eye, a hull covers the bearings around its own, as far as the circle around it reaches. The things in view
are sorted by eye and bearing, so that those within these bearings follow each other.
"""

from typing import NamedTuple

import numpy as np

from sim_host.sensing.random_streams import Floats, Vectors
from sim_host.sensing.sight_lines import Indices

_MARGIN = 1e-6
"""rad by which a shadow is widened, for the rounding of bearings; what is in it is tried exactly."""
_TURN = 2.0 * np.pi
_LIMIT = 4.0
"""rad; the bearings of lines are within ±π, and shadows are cut off here."""
_EYE_SPACING = 2.0 * _LIMIT
"""rad between the bearings of two eyes in one sorted array."""


class Candidates(NamedTuple):
    """Lines of sight with a hull that they may pass through; all arrays of the same length."""

    line: Indices
    """Index of the line."""
    hull: Indices
    """Body that has the hull; another than the eye."""


def hulls_near_lines(lines: Indices, places: Vectors, distance: Floats, reach: Floats) -> Candidates:
    """The hulls that may cross lines of sight.

    `lines` are indices in the arrays robots × things `places`, as seen from each robot, and `distance`; bodies, the
    things but the first, have the hulls, which lie within `reach`, per body. A line may also be near the hull of its
    own thing.
    """
    bearings = np.angle(places.reshape(-1).take(lines)) + _EYE_SPACING * (lines // places.shape[1])
    order = bearings.argsort()
    bearings = bearings.take(order)
    eye, hull, low, high = _shadows(places, distance, reach, distance.reshape(-1).take(lines).max(initial=0.0))
    start = bearings.searchsorted(low + _EYE_SPACING * eye)
    count = bearings.searchsorted(high + _EYE_SPACING * eye) - start
    before = count.cumsum() - count
    within = np.arange(count.sum()) + (start - before).repeat(count)
    return Candidates(order.take(within), hull.repeat(count))


def _shadows(
    places: Vectors, distance: Floats, reach: Floats, farthest: float
) -> tuple[Indices, Indices, Floats, Floats]:
    """Eye, body, and least and greatest bearing of each shadow; one across ±π is in two parts."""
    away = distance[:, 1:]
    is_near = away < farthest + reach
    np.fill_diagonal(is_near, False)
    eye, hull = np.nonzero(is_near)
    away, bearing, its_reach = away[is_near], np.angle(places[:, 1:][is_near]), reach.take(hull)
    with np.errstate(divide="ignore"):
        half = np.where(away > its_reach, np.arcsin(np.minimum(its_reach / away, 1.0)) + _MARGIN, np.pi + _MARGIN)
    low, high = bearing - half, bearing + half
    over, under = np.flatnonzero(high > np.pi), np.flatnonzero(low < -np.pi)
    parts = np.concatenate((np.arange(len(eye)), over, under))
    shift = np.concatenate((np.zeros(len(eye)), np.full(len(over), -_TURN), np.full(len(under), _TURN)))
    low, high = low.take(parts) + shift, high.take(parts) + shift
    return eye.take(parts), hull.take(parts), low.clip(-_LIMIT, _LIMIT), high.clip(-_LIMIT, _LIMIT)
