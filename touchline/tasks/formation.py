"""Formation: how far five robots get in a wedge. A member to start from, which goes where all their places agree."""

import math

from touchline import Briefing, Command, Moment, Radio, Score, Sight, skills

PLACES = ((0.8, 0.0), (0.0, 0.7), (0.0, -0.7), (-0.8, 1.4), (-0.8, -1.4))
"""m; place of each robot, in the order of the team, from the middle of the wedge. The wedge does not turn."""
WITHIN = 0.25
"""m from its place, up to which a robot is in formation."""
REACHED = 0.3
"""m from a corner, at which the next one is the target."""
SPEED = 0.7
"""m/s of the middle, as long as all are in their places."""


def travelled(now: Moment) -> Score:
    """m that the robots' middle has come nearer to one corner after the other, counted while all are in formation."""
    corners = [zone.place for zone in now.zones.values()]
    places = [(robot.x - x, robot.y - y) for robot, (x, y) in zip(now.robots.values(), PLACES, strict=True)]
    middle = middle_of(places)
    target, nearest, total = now.memory or (0, math.dist(middle, corners[0]), 0.0)
    away = math.dist(middle, corners[target])
    if all(math.dist(place, middle) <= WITHIN for place in places):
        total += max(0.0, nearest - away)
    nearest = min(nearest, away)
    if away <= REACHED:
        target = (target + 1) % len(corners)
        nearest = math.dist(middle, corners[target])
    return Score(total, memory=(target, nearest, total))


def middle_of(places: list[tuple[float, float]]) -> tuple[float, float]:
    """The mean of some places in m."""
    return sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)


class Member:
    """Keeps its place around the middle that it and its mates, as last heard, are around; this moves on."""

    def __init__(self, briefing: Briefing) -> None:
        assert briefing.setup.task is not None
        self.corners = [zone.place for zone in briefing.setup.task.zones]
        team = briefing.setup.teams[briefing.side].robots
        self.places = dict(zip(team, PLACES, strict=True))
        self.limits = skills.DriveLimits.of(briefing.setup)
        self.target = 0
        """Corners that the middle has reached."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        me, (x, y) = sight.self, self.places[sight.robot]
        agreed = [(me.x - x, me.y - y)]
        for name, heard in sight.radio.items():
            if heard.self is not None:
                then, (px, py) = heard.self, self.places[name]
                agreed.append((then.x + then.vx * heard.age - px, then.y + then.vy * heard.age - py))
                self.target = max(self.target, int(heard.extra.get("target", 0)))
        middle = middle_of(agreed)
        corner = self.corners[self.target % len(self.corners)]
        if math.dist(middle, corner) < 0.8 * REACHED:
            self.target += 1
        way = math.atan2(corner[1] - middle[1], corner[0] - middle[0])
        off = max(math.dist(place, middle) for place in agreed)
        speed = SPEED * max(0.0, 1.0 - off / (2.0 * WITHIN))
        vx = speed * math.cos(way) + 1.5 * (middle[0] + x - me.x)
        vy = speed * math.sin(way) + 1.5 * (middle[1] + y - me.y)
        drive = skills.drive(me, vx, vy, 0.0, self.limits)
        return Command(answers_tick=sight.tick, drive=drive, radio=Radio(self=me, extra={"target": self.target}))
