"""What hides what: lines of sight in the plane, from every robot to every thing, against the hulls in between."""

import numpy as np
from numpy.typing import NDArray

from sim_host.sensing.streams import Floats

Flags = NDArray[np.bool_]


def hidden(places: Floats, square: Floats, radius: Floats, is_tall: Flags) -> Flags:
    """Whether a hull stands before a thing, shape (eyes, things).

    `places` of the things as seen from each eye, m, shape (2, eyes, things), and their `square` distance. The hulls
    are the last of the things: `radius` of each, m, shape (hulls), and `is_tall`, whether it is high enough to hide a
    thing, shape (hulls, eyes, things). A thing is hidden when the line from the eye to its middle passes through a
    hull; the eye's own hull, and one that stands farther away, hides nothing.
    """
    hulls, things = len(radius), square.shape[1]
    x, y = places.reshape(2, -1)
    hull_x, hull_y = (np.repeat(part[:, things - hulls :].T, things, axis=1) for part in places)
    along = hull_x * x
    along += hull_y * y
    beside = hull_x * y
    beside -= hull_y * x
    flat = square.reshape(-1)
    hides = along > 0.0
    hides &= along < flat
    hides &= beside * beside < flat * (radius * radius)[:, None]
    hides &= is_tall.reshape(hulls, -1)
    found: Flags = np.logical_or.reduce(hides, axis=0).reshape(square.shape)
    return found
