"""The progress of one robot against the progress that its demands would have made if nothing had been in its way.

A free robot with the same demands and limits is carried along. Its motion leads the measured one by a bounded speed and
is drawn to it slowly, so that an obstacle is forgotten once the robot drives again. Translation and rotation count
together, rotation as the speed of the hull. Demand and both progresses are averages with exponential weights over the
window. Demands that flicker from tick to tick make a free robot slow, too, and are compared with that.
"""

import math

from schemas.config.sections import DriveLimits
from schemas.messages.command import Drive
from sim_host.snapshot import RobotState

_HULL = 0.25
"""m; lever at which a turn rate counts as a speed."""
_LEAST = 0.2
"""m/s; at a smaller demand, a stuck robot cannot be distinguished from a slow one."""
_LEAST_FREE = 0.04
"""m/s; a free robot that is slower makes no progress that a measured one could miss."""
_STUCK_BELOW, _FREE_FROM = 0.3, 0.5
"""Progress as a share of the demanded progress at which a robot becomes stuck, and free again."""
_LEAD = 0.6
"""m/s; the free robot's motion differs from the measured one by at most this, a quarter of a second's gain."""
_FORGETTING = 4.0
"""Windows in which the free robot's motion is drawn to the measured one."""
_SETTLED = 0.05
"""m/s; a robot whose motion differs by no more from the free one's is not held back."""


class HeldBackMotion:
    """The measured and the free motion of one robot, from the tick at which it is first held back."""

    def __init__(self, drive: DriveLimits, tick: float, now: RobotState) -> None:
        self._drive = drive
        self._share = min(1.0, tick / drive.stuck_window)
        self._gain = drive.acceleration * tick
        self._brake = max(drive.acceleration, drive.deceleration) * tick
        self._turn_gain = drive.turn_acceleration * _HULL * tick
        self._vx, self._vy, self._rim = now.vx, now.vy, now.omega * _HULL
        self._wanted = self._demanded = self._made = 0.0
        self._settled_for = 0.0
        self.stuck = False
        self.settled = False
        """The robot has moved as a free one does for a window, and needs no attention until it is held back again."""

    def update(self, now: RobotState, demand: Drive) -> None:
        """Compare the motion at the beginning of a tick with the free one, and carry that on with the tick's demand."""
        rim, share = now.omega * _HULL, self._share
        free = math.hypot(self._vx, self._vy, self._rim)
        made = (now.vx * self._vx + now.vy * self._vy + rim * self._rim) / free if free else 0.0
        self._demanded += (free - self._demanded) * share
        self._made += (made - self._made) * share
        missing = self._made < _STUCK_BELOW * self._demanded
        if missing and self._wanted > _LEAST and self._demanded > _LEAST_FREE:
            self.stuck = True
        elif self._made > _FREE_FROM * self._demanded or self._wanted < _LEAST / 2:
            self.stuck = False
        ahead = math.hypot(now.vx - self._vx, now.vy - self._vy, rim - self._rim)
        self._settled_for = 0.0 if self.stuck or ahead > _SETTLED else self._settled_for + share
        self.settled = self._settled_for >= 1.0
        kept = min(1.0 - share / _FORGETTING, _LEAD / ahead if ahead else 1.0)
        self._vx = now.vx + (self._vx - now.vx) * kept
        self._vy = now.vy + (self._vy - now.vy) * kept
        self._rim = rim + (self._rim - rim) * kept
        self._drive_on(now.heading, demand)

    def _drive_on(self, heading: float, demand: Drive) -> None:
        """The free robot's motion after the tick, within the limits of the drive."""
        drive = self._drive
        size = math.hypot(demand.vx, demand.vy)
        scale = min(1.0, drive.max_speed / size) if size else 0.0
        c, s = scale * math.cos(heading), scale * math.sin(heading)
        dx = c * demand.vx - s * demand.vy - self._vx
        dy = s * demand.vx + c * demand.vy - self._vy
        change = math.hypot(dx, dy)
        if change:
            gains_speed = dx * self._vx + dy * self._vy >= 0.0
            reached = min(1.0, (self._gain if gains_speed else self._brake) / change)
            self._vx += reached * dx
            self._vy += reached * dy
        rim = max(-drive.max_turn_rate, min(drive.max_turn_rate, demand.omega)) * _HULL
        self._wanted += (math.hypot(scale * size, rim) - self._wanted) * self._share
        self._rim += max(-self._turn_gain, min(self._turn_gain, rim - self._rim))
