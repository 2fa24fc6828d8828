"""The sections of a rule book that say what breaks the rules in play: numbers, and which fouls are called at all."""

from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity

CALLS = ("off", "on", "yellow")
"""How a foul is called: not at all; with its restart; with its restart and a yellow card for the offender."""


@dataclass(frozen=True, slots=True)
class Handling:
    """How a robot may handle the ball."""

    circle: Annotated[float, Quantity("m", "the ball is dribbled this far from where it was caught", 0.5, 50)]
    release_gap: Annotated[float, Quantity("m", "air between hull and ball that shows that it was released", 0, 2)]
    backward_distance: Annotated[float, Quantity("m", "driven backward with the ball at most", 0.1, 50)]
    backward_once: Annotated[float, Quantity("m", "a longer way backward may not be repeated", 0.1, 50)]
    backward_again: Annotated[float, Quantity("m", "a repeated way backward is noticed from here on", 0.01, 1)]
    struggle_duration: Annotated[float, Quantity("s", "a longer struggle allows driving backward anew", 0, 60)]
    roll_duration: Annotated[float, Quantity("s", "the ball is moved without turning at most", 0, 60)]
    roll_distance: Annotated[float, Quantity("m", "the ball is moved without turning at most", 0, 10)]
    roll_pause: Annotated[float, Quantity("s", "wait before the ball may be moved without turning again", 0, 60)]
    hold_duration: Annotated[float, Quantity("s", "one robot keeps the ball at most", 1, 120)]


@dataclass(frozen=True, slots=True)
class Areas:
    """Who may be in goal areas and penalty areas, and for how long."""

    goal_area_duration: Annotated[float, Quantity("s", "another robot than the goalkeeper in a goal area", 0, 600)]
    penalty_area_robots: Annotated[
        int, Quantity("1", "robots of one side in a penalty area, besides the goalkeeper in its own", 0, 11)
    ]
    penalty_area_duration: Annotated[float, Quantity("s", "more robots than that in a penalty area", 0, 600)]


@dataclass(frozen=True, slots=True)
class Contact:
    """How robots may touch each other, and where they may be."""

    push_distance: Annotated[float, Quantity("m", "a robot moves an opponent by leaning on it, at most", 0.05, 10)]
    stand_off_duration: Annotated[float, Quantity("s", "two opponents lean on each other at most", 1, 120)]
    outside_duration: Annotated[float, Quantity("s", "a robot is wholly outside the lines at most", 0, 600)]


@dataclass(frozen=True, slots=True)
class Scoring:
    """Which goals count, and which kicks from the own half are allowed."""

    pass_roll: Annotated[float, Quantity("m", "free roll that makes a pass", 0, 10)]
    robots_touched: Annotated[int, Quantity("1", "robots of the taker's side that touched it before a goal", 1, 5)]
    lob_height: Annotated[float, Quantity("m", "apex of the ball's underside above which a kick is a lob", 0, 5)]
    lob_teammate: Annotated[float, Quantity("m", "a teammate this near to where it lands makes it a pass", 0, 20)]
    lob_robots: Annotated[int, Quantity("1", "robots of its side on the field from which on a lob is judged", 1, 11)]


@dataclass(frozen=True, slots=True)
class Scrum:
    """When a ball that both sides contest is dropped."""

    reach: Annotated[float, Quantity("m", "air between hull and ball within which a robot is at the ball", 0, 2)]
    progress: Annotated[float, Quantity("m", "a contested ball that comes this far makes progress", 0.05, 10)]
    duration: Annotated[float, Quantity("s", "both sides at the ball without progress, at most", 1, 120)]


@dataclass(frozen=True, slots=True)
class Fouls:
    """Which fouls are called: `off`, `on`, or `yellow` for a yellow card beside the restart; named as their rules."""

    direct_goal: Annotated[str, Choice("a goal straight from the restart", CALLS)]
    own_half_goal: Annotated[str, Choice("a goal from the own half, or without a pass when won there", CALLS)]
    dribble_circle: Annotated[str, Choice("dribbling out of the circle around the catch", CALLS)]
    backward: Annotated[str, Choice("driving backward with the ball", CALLS)]
    not_rolling: Annotated[str, Choice("moving a ball that does not turn", CALLS)]
    long_hold: Annotated[str, Choice("keeping the ball for long", CALLS)]
    goal_area: Annotated[str, Choice("another than the goalkeeper in a goal area", CALLS)]
    penalty_area: Annotated[str, Choice("a crowded penalty area", CALLS)]
    pushing: Annotated[str, Choice("pushing an opponent away", CALLS)]
    lob: Annotated[str, Choice("a lob from the own half that is no pass", CALLS)]
    leaving_field: Annotated[str, Choice("leaving the field", CALLS)]
