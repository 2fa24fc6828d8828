"""Lines of sight from an eye to a thing, and the hulls, seen from above, that they pass through.

All places are relative to the eye, x + iy in m. The arrays of a function are broadcast against each other.
"""

import numpy as np
from numpy.typing import NDArray

from sim_host.sensing.random_streams import Floats, Vectors

Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

_EYE = np.array(0.0)
"""m; along a line."""
_LEAST = 1e-12
"""m; the smallest component of a line along a side of a box, to avoid a division by zero."""


def through_circles(turned: Vectors, distance: Floats, radius: Floats) -> Flags:
    """Whether the line to a thing passes through a circle between the eye and the thing.

    `turned` is the place of the thing times the conjugate of the circle's centre; `distance` that of the thing.
    """
    along, beside = turned.real, turned.imag  # of the circle's centre, times the length of the line
    hides: Flags = along > _EYE
    hides &= along < distance * distance
    hides &= np.abs(beside) < distance * radius
    return hides


def through_boxes(places: Vectors, centres: Vectors, headings: Vectors, halves: Floats) -> Flags:
    """Whether the line to a thing enters a box before it reaches the thing.

    `places` of the things; `centres` of the boxes; `headings` of the boxes, of unit length; `halves` of their sides, in
    pairs on the first axis.
    """
    back = headings.conj()
    enters, leaves = box_crossings(-back * centres, back * places, halves)
    found: Flags = (enters < leaves) & (leaves > 0.0) & (enters < 1.0)
    return found


def box_crossings(eyes: Vectors, ways: Vectors, halves: Floats) -> tuple[Floats, Floats]:
    """Where lines from some eyes enter boxes and leave them, in units of `ways`; one that misses leaves first.

    `eyes` and `ways` are in the frames of the boxes, from their centres; `halves` as in `through_boxes`.
    """
    places, steps = np.stack((eyes.real, eyes.imag)), np.stack((ways.real, ways.imag))
    steps = np.where(np.abs(steps) < _LEAST, _LEAST, steps)
    one, other = (-halves - places) / steps, (halves - places) / steps
    return np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
