"""Intersections of lines of sight, from every eye to every thing, with hulls seen from above.

Arrays are (hulls, eyes, things). All places are relative to the eye, x + iy in m.
"""

import numpy as np
from numpy.typing import NDArray

from sim_host.sensing.random_streams import Floats, Vectors

Flags = NDArray[np.bool_]

_EYE = np.array(0.0)
"""m; along a line."""
_LEAST = 1e-9
"""m; the smallest component of a line along a side of a box, to avoid a division by zero."""


def through_circles(places: Vectors, distance: Floats, centres: Vectors, radius: Floats) -> Flags:
    """Which lines pass through which circles between the eye and the thing.

    `places` of the things, shape (eyes, things), with their `distance`; `centres`, shape (eyes, hulls).
    """
    hulls, eyes, things = len(radius), *distance.shape
    line = centres.T.repeat(things, axis=1)
    np.conjugate(line, out=line)
    line *= places.reshape(-1)
    along, beside = line.real, line.imag  # of the circle's centre, times the length of the line
    flat = distance.reshape(-1)
    hides: Flags = along > _EYE
    hides &= along < flat * flat
    hides &= np.abs(beside) < flat * radius[:, None]
    return hides.reshape(hulls, eyes, things)


def through_boxes(places: Vectors, centres: Vectors, turned: Vectors, halves: Floats) -> Flags:
    """Which lines enter which boxes before they reach the thing.

    `centres`, shape (boxes, eyes); `turned`, of unit length, the headings of the boxes; `halves` of the sides, shape
    (2, boxes).
    """
    back = turned.conj()[:, None]
    eye, way = -back * centres, back[..., None] * places
    eye_parts = np.stack((eye.real, eye.imag))[..., None]
    way_parts = np.stack((way.real, way.imag))
    way_parts = np.where(np.abs(way_parts) < _LEAST, _LEAST, way_parts)
    half = halves[:, :, None, None]
    one, other = (-half - eye_parts) / way_parts, (half - eye_parts) / way_parts
    enters, leaves = np.minimum(one, other).max(axis=0), np.maximum(one, other).min(axis=0)
    found: Flags = (enters < leaves) & (leaves > 0.0) & (enters < 1.0)
    return found
