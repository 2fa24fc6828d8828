"""Rendezvous: for how long robots that know no places are together. A stranger to start from, by scan and compass."""

import cmath
import math

from touchline import Briefing, Command, CompassReading, Drive, Moment, RangeReading, Score, Sight

TOGETHER = 1.5
"""m from the middle of all robots, within which each of them has to be."""
ROOM = 0.6
"""m from middle to middle, which a robot keeps from the one ahead."""
JUMP = 0.4
"""m; two beams side by side whose distances differ by more meet different bodies."""


def together(now: Moment) -> Score:
    """s for which all have been together; a learner is also paid for each m by which the farthest comes nearer."""
    places = [complex(robot.x, robot.y) for robot in now.robots.values()]
    middle = sum(places) / len(places)
    farthest = max(abs(place - middle) for place in places)
    time, value, before = now.memory or (0.0, 0.0, farthest)
    gain = now.time - time if farthest <= TOGETHER else 0.0
    return Score(value + gain, reward=gain + before - farthest, memory=(now.time, value + gain, farthest))


class Stranger:
    """Drives to the middle of the smallest circle around itself and all that it sees, so that it loses none of them.

    It uses neither its place nor the camera nor the radio: what its beams meet on the open floor are the others.
    """

    def __init__(self, briefing: Briefing) -> None:
        self.limits, self.radius = briefing.setup.drive, briefing.setup.robot.radius
        self.seen: list[complex] = []
        """m; the others from this robot, in the direction of the compass, when the range finder was read last."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        compass, scan = sight.sensors["compass"], sight.sensors["scan"]
        assert isinstance(compass, CompassReading) and isinstance(scan, RangeReading)
        ahead = cmath.rect(1.0, compass.heading)
        if scan.age == 0.0:
            self.seen = [place * ahead for place in self.bodies(scan)]
        goal = middle_of([0j, *self.seen]) / ahead
        near = min((abs(one) for one in self.seen if (one / ahead).real > 0.5 * abs(one)), default=math.inf)
        speed = min(self.limits.max_speed, 1.5 * max(0.0, goal.real), 2.0 * max(0.0, near - ROOM))
        turn = 3.0 * cmath.phase(goal) if abs(goal) > 0.1 else 0.0
        return Command(answers_tick=sight.tick, drive=Drive(vx=speed, omega=turn))

    def bodies(self, scan: RangeReading) -> list[complex]:
        """The middles of the bodies in a scan, m: ahead is real, to the left imaginary."""
        groups: list[list[complex]] = []
        last = math.inf
        for beam, distance in enumerate(scan.distances):
            if distance is None:
                last = math.inf
                continue
            if abs(distance - last) > JUMP:
                groups.append([])
            groups[-1].append(cmath.rect(distance + self.radius, scan.angle_min + beam * scan.angle_increment))
            last = distance
        return [sum(group) / len(group) for group in groups]


def middle_of(places: list[complex], steps: int = 20) -> complex:
    """About the middle of the smallest circle around some places, by ever shorter steps toward the farthest."""
    middle = sum(places) / len(places)
    for step in range(2, steps):
        middle += (max(places, key=lambda place: abs(place - middle)) - middle) / step
    return middle
