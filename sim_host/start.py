"""Where robots stand at the beginning of a half, in the field frame, for cyan attacking +x."""

from schemas.frames import Pose
from schemas.profile import Field
from schemas.side import Side
from sim_host.snapshot import Roster

_ON_22_BY_14 = ((-10.5, 0.0), (-2.0, 1.0), (-2.0, -1.0), (-5.0, 2.0), (-5.0, -2.0))
"""m; simatch's start poses on a pitch of 22 × 14, the goalkeeper first; scaled to other pitches."""


def start_poses(roster: Roster, pitch: Field) -> dict[str, Pose]:
    """One pose for each robot: all in their own half, facing the goal they attack, magenta's cyan's turned by π."""
    poses = {}
    for side in Side:
        mine = [name for name, its_side in zip(roster.names, roster.sides, strict=True) if its_side is side]
        for name, (x, y) in zip(mine, _ON_22_BY_14, strict=False):
            poses[name] = Pose(x * pitch.length / 22.0, y * pitch.width / 14.0).team(side.attack(1))
    return poses
