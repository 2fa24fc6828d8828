"""Warehouse: deliveries of eight robots without collisions. A carrier to start from, on a one-way road."""

import math

from touchline import Briefing, Command, Moment, Motion, Radio, Score, Sight, skills

STANDS = 0.1
"""m/s; a robot that is slower stands."""
ROAD = ((-5.8, 2.0), (-5.8, 3.3), (5.8, 3.3), (5.8, 2.0), (5.8, 0.65), (-5.8, 0.65))
"""m; the corners of the northern road and its two stops, in order; the southern one is its mirror image."""
STOPS = (0, 3)
"""Places of the stops in the road: to fetch, and to deliver."""
CAREFUL = 1.4
"""m from middle to middle, where a robot begins to slow down behind the one ahead."""
CLOSE = 0.8
"""m from middle to middle, where it has stopped."""


def delivered(now: Moment) -> Score:
    """Deliveries less collisions: a robot fetches where it stands in a zone "pick", and delivers in a zone "drop"."""
    laden, touching, value = now.memory or ([], [], 0)
    laden, events = set(laden), []
    for name, robot in now.robots.items():
        if math.hypot(robot.vx, robot.vy) > STANDS:
            continue
        kinds = {zone.name.partition("_")[0] for zone in now.zones.values() if zone.contains(robot.x, robot.y)}
        if "pick" in kinds:
            laden.add(name)
        elif "drop" in kinds and name in laden:
            laden.remove(name)
            value += 1
            events.append(f"{name} delivers")
    pairs = sorted(f"{one} and {other}" for one, other in now.contacts)
    collisions = [f"{pair} collide" for pair in pairs if pair not in touching]
    value -= len(collisions)
    return Score(value, memory=(sorted(laden), pairs, value), events=events + collisions)


class Carrier:
    """Goes round on the road of its half, stops where it fetches and delivers, and keeps off the robot ahead."""

    def __init__(self, briefing: Briefing) -> None:
        half = 1.0 if briefing.number <= 4 else -1.0
        self.road = [(x, half * y) for x, y in ROAD]
        self.limits = skills.DriveLimits.of(briefing.setup)
        self.next = 0
        """Place in the road that it drives to."""
        self.stood = 0
        """Ticks for which it has stood at a stop."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        me = sight.self
        x, y = self.road[self.next]
        away = math.dist((x, y), (me.x, me.y))
        if self.next in STOPS:
            self.stood = self.stood + 1 if away < 0.3 and math.hypot(me.vx, me.vy) < STANDS else 0
            is_done = self.stood > 10
        else:
            is_done = away < 0.5
        if is_done:
            self.next, self.stood = (self.next + 1) % len(self.road), 0
        others = [heard.self for heard in sight.radio.values() if heard.self is not None]
        gap = min((self.gap(me, other, (x, y)) for other in others), default=math.inf)
        limits = self.limits.capped(self.limits.speed * max(0.0, min(1.0, (gap - CLOSE) / (CAREFUL - CLOSE))))
        drive = skills.go_to(me, x, y, math.atan2(y - me.y, x - me.x), limits)
        return Command(answers_tick=sight.tick, drive=drive, radio=Radio(self=me))

    @staticmethod
    def gap(me: Motion, other: Motion, goal: tuple[float, float]) -> float:
        """m to another robot that is on the way to a place; infinite for one that is not."""
        dx, dy = other.x - me.x, other.y - me.y
        way = math.atan2(goal[1] - me.y, goal[0] - me.x)
        along, across = dx * math.cos(way) + dy * math.sin(way), dy * math.cos(way) - dx * math.sin(way)
        return math.hypot(dx, dy) if along > 0.0 and abs(across) < 0.6 else math.inf
