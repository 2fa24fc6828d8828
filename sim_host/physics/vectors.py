"""Plain types of mechanics, without PyBullet: vectors, orientations, and motions in the plane."""

from collections.abc import Sequence

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w."""
FieldTwist = Sequence[float]
"""vx, vy in m/s and omega in rad/s, field frame."""
