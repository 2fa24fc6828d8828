"""Covers a floor: goes to the nearest cell that no robot of the team is known to have been on."""

import math

from touchline import Briefing, Command, Motion, Radio, Sight, skills

PATIENCE = 5.0
"""s without coming nearer to a cell, after which the robot gives it up."""


class Rover:
    def __init__(self, briefing: Briefing) -> None:
        pitch, self.limits = briefing.setup.pitch, skills.DriveLimits.of(briefing.setup)
        self.room = briefing.setup.robot.radius + 0.15
        half_x, half_y = int(pitch.length / 2), int(pitch.width / 2)
        self.open = {(x + 0.5, y + 0.5) for x in range(-half_x, half_x) for y in range(-half_y, half_y)}
        self.goal, self.best, self.since = None, math.inf, 0.0

    def act(self, sight: Sight) -> Command:
        me, mates = sight.self, [heard for heard in sight.radio.values() if heard.self is not None]
        for at in (me, *(heard.self for heard in mates)):
            self.open.discard((math.floor(at.x) + 0.5, math.floor(at.y) + 0.5))
        self.choose(sight.time, me, [(heard.self.x, heard.self.y, heard.extra) for heard in mates])
        radio = Radio(self=me)
        if self.goal is None:
            return Command(answers_tick=sight.tick, radio=radio)
        x, y = self.goal
        blocked = skills.circles(self.hits(sight, me), self.room)
        drive = skills.go_around(me, x, y, me.heading, blocked, self.limits)
        return Command(answers_tick=sight.tick, drive=drive, radio=radio.replace(extra={"x": x, "y": y}))

    def choose(self, time: float, me: Motion, mates: list) -> None:
        """Keep the cell while it is open and comes nearer, else take the nearest that no mate is nearer to."""
        if self.goal in self.open and time - self.since < PATIENCE:
            away = math.dist(self.goal, (me.x, me.y))
            if away < self.best - 0.1:
                self.best, self.since = away, time
            return
        if self.goal in self.open:
            self.open.discard(self.goal)  # it cannot be reached
        taken = [((extra.get("x"), extra.get("y")), x, y) for x, y, extra in mates]
        free = [cell for cell in self.open if all(cell != theirs for theirs, _, _ in taken)] or self.open

        def cost(cell: tuple[float, float]) -> tuple[float, ...]:
            crowd = sum(math.dist(cell, (x, y)) < 3.0 for _, x, y in taken)
            return math.dist(cell, (me.x, me.y)) + crowd, *cell

        self.goal = min(free, key=cost, default=None)
        self.best, self.since = math.inf, time

    def hits(self, sight: Sight, me: Motion) -> list[tuple[float, float]]:
        """Where the beams have met something within 2 m."""
        scan = sight.sensors.get("scan")
        if scan is None:
            return []
        found = []
        for beam, distance in enumerate(scan.distances):
            if distance is not None and distance < 2.0:
                angle = me.heading + scan.angle_min + beam * scan.angle_increment
                found.append((me.x + distance * math.cos(angle), me.y + distance * math.sin(angle)))
        return found
