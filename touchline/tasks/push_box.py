"""Push a box: by how much it comes nearer to a dock. A mover to start from, which pushes when all are in line."""

import math

from touchline import Briefing, Command, Moment, Radio, Score, Sight, skills

PLACES = (-0.65, 0.0, 0.65)
"""m; where the movers push, across the way to the dock."""
BEHIND = 0.65
"""m from the middle of the box to that of a mover that touches it."""
STAND_OFF = 0.2
"""m more than that, where a mover waits for the others."""
SPEED = 0.8
"""m/s; of the line that pushes."""
BROAD = 0.7
"""m; the camera's circle around the box is larger than this, that around a robot smaller."""


def nearer(now: Moment) -> Score:
    """m by which the box is nearer to the dock than at first; there it ends."""
    box, dock = now.obstacles["box"], now.zones["dock"]
    away = math.dist((box.x, box.y), dock.place)
    first = now.memory or away
    return Score(first - away, over=dock.contains(box.x, box.y), memory=first)


class Mover:
    """Lines up with the others behind the box, and then pushes it toward the dock in line with them."""

    def __init__(self, briefing: Briefing) -> None:
        assert briefing.setup.task is not None
        self.dock = briefing.setup.task.zones[0].place
        self.place = PLACES[briefing.number - 1]
        self.team = {briefing.robot, *briefing.teammates}
        self.limits = skills.DriveLimits.of(briefing.setup)
        self.box = (0.0, 0.0)
        """m; where the camera saw it last."""
        self.ready: set[str] = set()
        """Robots that have lined up."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        me = sight.self
        self.box = next(((one.x, one.y) for one in sight.obstacles if one.radius > BROAD), self.box)
        self.ready |= {name for name, heard in sight.radio.items() if heard.role == "ready"}
        way = math.atan2(self.dock[1] - self.box[1], self.dock[0] - self.box[0])
        c, s = math.cos(way), math.sin(way)
        dx, dy = me.x - self.box[0], me.y - self.box[1]
        ahead, aside = c * dx + s * dy + BEHIND, c * dy - s * dx - self.place
        """m; how far the robot is from its place at the box."""
        if abs(ahead + STAND_OFF) < 0.1 and abs(aside) < 0.1:
            self.ready.add(sight.robot)
        if self.ready == self.team:
            speed, across = SPEED - 1.0 * ahead, -1.5 * aside
            drive = skills.drive(me, c * speed - s * across, s * speed + c * across, 0.0, self.limits)
        else:
            x = me.x - c * (ahead + STAND_OFF) + s * aside
            y = me.y - s * (ahead + STAND_OFF) - c * aside
            drive = skills.go_to(me, x, y, way, self.limits)
        radio = Radio(self=me, role="ready" if sight.robot in self.ready else None)
        return Command(answers_tick=sight.tick, drive=drive, radio=radio)
