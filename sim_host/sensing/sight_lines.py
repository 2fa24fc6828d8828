"""What stands in a line of sight: segments in the plane, from every eye to every thing, against hulls seen from above.

Arrays are (hulls, eyes, things). All places are relative to the eye, m.
"""

import numpy as np
from numpy.typing import NDArray

from sim_host.sensing.streams import Floats

Flags = NDArray[np.bool_]

_LEAST = 1e-9
"""m; a line that is more nearly parallel to the side of a box is taken to lean by as much."""


def through_circles(places: Floats, square: Floats, centres: Floats, radius: Floats) -> Flags:
    """Which lines pass through which circles that stand before the thing, beyond the eye.

    `places` of the things, shape (2, eyes, things), with their `square` distance; `centres`, shape (2, eyes, hulls).
    """
    hulls, eyes, things = len(radius), *square.shape
    x, y = places.reshape(2, -1)
    hull_x, hull_y = (np.repeat(part.T, things, axis=1) for part in centres)
    along = hull_x * x
    along += hull_y * y
    beside = hull_x * y
    beside -= hull_y * x
    flat = square.reshape(-1)
    hides: Flags = along > 0.0
    hides &= along < flat
    hides &= beside * beside < flat * (radius * radius)[:, None]
    return hides.reshape(hulls, eyes, things)


def through_boxes(places: Floats, centres: Floats, headings: Floats, halves: Floats) -> Flags:
    """Which lines enter which boxes before they reach the thing.

    `centres`, shape (2, boxes, eyes); `headings`, rad, shape (boxes); `halves` of the sides, shape (2, boxes).
    """
    c, s = np.cos(headings)[:, None], np.sin(headings)[:, None]
    eye = np.stack((-c * centres[0] - s * centres[1], s * centres[0] - c * centres[1]))[..., None]
    c, s = c[..., None], s[..., None]
    way = np.stack((c * places[0] + s * places[1], c * places[1] - s * places[0]))
    way = np.where(np.abs(way) < _LEAST, _LEAST, way)
    half = halves[:, :, None, None]
    one, other = (-half - eye) / way, (half - eye) / way
    enters, leaves = np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
    found: Flags = (enters < leaves) & (leaves > 0.0) & (enters < 1.0)
    return found
