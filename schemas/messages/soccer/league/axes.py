"""Transforms between the field frame and the league's axes: +y toward the opponents' goal, +x to the right of it.

The league's axes are each team's: its team frame turned by a quarter. In both, heading 0 is toward the
opponents' goal. All functions take numbers or arrays, in m and rad; `attack` is +1 or −1, the x direction of the field
frame that the team attacks.
"""

from typing import Any

import numpy as np

from schemas.frames import TAU


def vector_to_log(x: Any, y: Any, attack: Any) -> tuple[Any, Any]:
    """A position or velocity of the field frame in the league's axes."""
    return -attack * y, attack * x


def vector_to_field(x: Any, y: Any, attack: Any) -> tuple[Any, Any]:
    """A position or velocity of the league's axes in the field frame."""
    return attack * y, -attack * x


def heading_across(heading: Any, attack: Any) -> Any:
    """A heading of one frame in the other, in (−π, π]; they differ by half a turn for the team that attacks −x."""
    turned = np.asarray(heading) + np.where(np.asarray(attack) > 0, 0.0, np.pi)
    return np.pi - (np.pi - turned) % TAU
