"""The team frame of each robot as the robot believes it to lie."""

from typing import NamedTuple

from sim_host.sensing.random_streams import Floats, Vectors


class TeamFrames(NamedTuple):
    """The believed team frames: a robot at a place in the field frame believes itself at `sign · place + shift`.

    Vectors from the robot to other things are true, but turned by `turn`.
    """

    sign: Vectors
    """1, or −1 for robots that attack −x; complex, as the numbers that it is multiplied with."""
    shift: Vectors
    """m."""
    turn: Vectors
    """Of unit length; turns vectors of the field into the frame."""
    angle: Floats
    """rad; the angle of `turn`."""
