"""Where each robot believes its team frame to lie."""

from typing import NamedTuple

from sim_host.sensing.random_streams import Floats, Vectors


class TeamFrames(NamedTuple):
    """The team frame of each robot as that robot believes it to lie: a place of the field is `sign · place + shift`.

    Things near a robot lie about its own place as they do in truth, turned by `turn` with everything else.
    """

    sign: Vectors
    """1, or −1 for who attacks −x; complex as what it is multiplied with."""
    shift: Vectors
    """m."""
    turn: Vectors
    """Of unit length; turns what is seen of the field into the frame."""
    angle: Floats
    """rad; by which `turn` turns."""
