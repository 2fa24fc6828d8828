"""Pursuit: how soon three robots catch a quicker one. Hunters that surround it to start from, and the fox."""

import cmath
import math

from touchline import Briefing, Command, Moment, Radio, Score, Sight, skills

OF_A_MATE = 0.6
"""m; what the camera sees within this of where a mate says that it is, is the mate."""
SHARE = 0.6
"""How far beside the fox a hunter aims, as a share of its distance."""
NEAR = 1.2
"""m from the fox, where a hunter drives straight at it."""
AHEAD = 0.8
"""s; how far the fox looks ahead."""
WALL = 0.9
"""m from the wall, where the fox begins to mind it."""


def caught(now: Moment) -> Score:
    """Minus the time in s until a hunter touches the fox; a learner is also paid for each m that they come nearer."""
    fox = now.robots["fox"]
    hunters = [name for name, side in now.sides.items() if side == "cyan"]
    gap = sum(math.dist((fox.x, fox.y), (now.robots[name].x, now.robots[name].y)) for name in hunters) / len(hunters)
    before, time = now.memory or (gap, 0.0)
    over = any("fox" in pair for pair in now.contacts)
    return Score(-now.time, over=over, reward=before - gap - (now.time - time), memory=(gap, now.time))


class Hunter:
    """Drives to its own side of the fox while it is far from it, and straight at it when it is near."""

    def __init__(self, briefing: Briefing) -> None:
        self.pitch, self.limits = briefing.setup.pitch, skills.DriveLimits.of(briefing.setup)
        self.fox = 0j
        """m; where it was seen last."""

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        me = complex(sight.self.x, sight.self.y)
        mates = {name: complex(heard.self.x, heard.self.y) for name, heard in sight.radio.items() if heard.self}
        spots = [heard.extra for heard in sight.radio.values() if heard.extra]
        told = [complex(float(spot["x"]), float(spot["y"])) for spot in spots]
        seen = [complex(one.x, one.y) for one in sight.obstacles]
        seen = [one for one in seen if all(abs(one - mate) > OF_A_MATE for mate in mates.values())]
        self.fox = min(seen or told, key=lambda one: abs(one - me), default=self.fox)
        away = abs(self.fox - me)
        beside = SHARE * away if away > NEAR else 0.0
        goal = self.fox + cmath.rect(beside, self.sides({sight.robot: me, **mates})[sight.robot])
        way = self.inside(goal) - me
        way *= self.limits.speed / max(abs(way), 1e-6)
        drive = skills.drive(sight.self, way.real, way.imag, 0.0, self.limits)
        radio = Radio(self=sight.self, extra={"x": self.fox.real, "y": self.fox.imag} if seen else {})
        return Command(answers_tick=sight.tick, drive=drive, radio=radio)

    def inside(self, place: complex) -> complex:
        """The place on the floor that is nearest to a place."""
        x, y = self.pitch.goal_line, self.pitch.touch_line
        return complex(max(-x, min(x, place.real)), max(-y, min(y, place.imag)))

    def sides(self, team: dict[str, complex]) -> dict[str, float]:
        """Robot → the direction from the fox, rad, that it comes from: evenly all round, and near to where it is."""
        bearings = {name: cmath.phase(place - self.fox) for name, place in team.items()}
        order, apart = sorted(bearings, key=lambda name: bearings[name]), math.tau / len(bearings)
        turned = [cmath.rect(1.0, bearings[name] - number * apart) for number, name in enumerate(order)]
        first = cmath.phase(sum(turned))
        return {name: first + number * apart for number, name in enumerate(order)}


class Fox:
    """Runs where the hunters are farthest off in a moment, and minds the walls."""

    def __init__(self, briefing: Briefing) -> None:
        pitch = briefing.setup.pitch
        self.half = complex(pitch.goal_line + pitch.border, pitch.touch_line + pitch.border)
        self.limits = skills.DriveLimits.of(briefing.setup)

    def act(self, sight: Sight) -> Command:
        """The command for one sight."""
        me = complex(sight.self.x, sight.self.y)
        hunters = [complex(one.x, one.y) for one in sight.obstacles]
        ways = [cmath.rect(self.limits.speed, math.tau * number / 24) for number in range(24)]
        way = max(ways, key=lambda way: self.safety(me + AHEAD * way, hunters))
        drive = skills.drive(sight.self, way.real, way.imag, 0.0, self.limits)
        return Command(answers_tick=sight.tick, drive=drive)

    def safety(self, place: complex, hunters: list[complex]) -> float:
        """m to the nearest hunter, less what it is too near to a wall."""
        room = min(self.half.real - abs(place.real), self.half.imag - abs(place.imag))
        return min((abs(one - place) for one in hunters), default=0.0) - 2.0 * max(0.0, WALL - room)
