"""Lob from the own half: a high kick from the own half must be a pass.

It is a foul if the ball rose above 60 cm, no teammate of the kicker is near the place where it comes down, and the
kicker's side has at least three robots on the field. The other side gets a free kick on the halfway line.

Section: play, lob shots.
Measures: the place of the kicker's centre at the kick, the greatest height of the ball's underside, and the place where
it first came down. Robots whose hull is wholly outside the lines do not count as on the field.
Not judged: a ball that is touched, or that leaves the field, before it comes down.
"""

import math

from sim_host.soccer.referee.evidence.flight import Flight
from sim_host.soccer.referee.evidence.zones import is_outside
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import foul, is_called
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side on the halfway line, or None."""
    flight = situation.state.evidence.flight
    if flight is None or not flight.just_landed or flight.landed is None:
        return None
    match, robots = situation.match, situation.snapshot.robots
    numbers, roster = match.book.scoring, match.roster
    side = roster.side_of(flight.robot)
    if flight.apex <= numbers.lob_height or flight.kicked_from[0] * situation.state.attack(side) >= 0:
        return None
    mates = [
        index
        for index, (its, robot) in enumerate(zip(roster.sides, robots, strict=True))
        if its is side and not is_outside(match, index, robot.x, robot.y)
    ]
    if len(mates) < numbers.lob_robots:
        return None
    away = [
        math.dist(flight.landed, (robots[index].x, robots[index].y))
        for index in mates
        if roster.names[index] != flight.robot
    ]
    if min(away) <= numbers.lob_teammate or not is_called(situation, "lob"):
        return None
    text = (
        f"{flight.robot} lobbed from its own half, {flight.apex:.2f} m high, limit {numbers.lob_height:.2f}; the "
        f"nearest teammate is {min(away):.2f} m from where it came down, {place_text(flight.landed)}"
    )
    return foul(
        situation,
        "lob",
        (flight.robot,),
        text,
        (flight.apex, numbers.lob_height, "m"),
        flight.kicked_from,
        restart_from=(0.0, _across(flight, flight.landed)),
    )


def _across(flight: Flight, landed: tuple[float, float]) -> float:
    """y in m where the lob crosses the halfway line, or where it came down if it did not get that far."""
    (x, y), (to_x, to_y) = flight.kicked_from, landed
    return y + (to_y - y) * x / (x - to_x) if x * to_x < 0 else to_y
