"""The sections of a rule book on fouls in play: their numbers, and which of them are called."""

from dataclasses import dataclass
from typing import Annotated

from schemas.config.quantity import Choice, Quantity

CALLS = ("off", "on", "yellow")
"""How a foul is called: not at all, with its restart, or with its restart and a yellow card for the offender."""


@dataclass(frozen=True, slots=True)
class Handling:
    """How a robot may handle the ball."""

    circle: Annotated[float, Quantity("m", "the ball is dribbled this far from where it was caught", 0.5, 50)]
    release_gap: Annotated[
        float, Quantity("m", "gap between hull and ball from which on the ball counts as released", 0, 2)
    ]
    backward_distance: Annotated[float, Quantity("m", "longest way backward with the ball", 0.1, 50)]
    backward_once: Annotated[float, Quantity("m", "a longer way backward may not be repeated", 0.1, 50)]
    backward_again: Annotated[float, Quantity("m", "a repeated way backward counts from this length on", 0.01, 1)]
    struggle_duration: Annotated[float, Quantity("s", "a longer struggle allows driving backward again", 0, 60)]
    roll_duration: Annotated[float, Quantity("s", "longest time that the ball is moved without rolling", 0, 60)]
    roll_distance: Annotated[float, Quantity("m", "longest way that the ball is moved without rolling", 0, 10)]
    roll_pause: Annotated[float, Quantity("s", "pause before the ball may be moved without rolling again", 0, 60)]
    hold_duration: Annotated[float, Quantity("s", "longest time that one robot keeps the ball", 1, 120)]


@dataclass(frozen=True, slots=True)
class Areas:
    """Which robots may be in goal areas and penalty areas, and for how long."""

    goal_area_duration: Annotated[
        float, Quantity("s", "longest time of a robot other than the goalkeeper in a goal area", 0, 600)
    ]
    penalty_area_robots: Annotated[
        int, Quantity("1", "robots of one side in a penalty area, besides the goalkeeper in its own", 0, 11)
    ]
    penalty_area_duration: Annotated[
        float, Quantity("s", "longest time of more robots than that in a penalty area", 0, 600)
    ]
    penalty_area_stay: Annotated[
        float, Quantity("s", "longest time of one robot in a penalty area, alone or not; 0: no limit", 0, 600)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class Contact:
    """How robots may touch each other, and where they may be."""

    push_distance: Annotated[float, Quantity("m", "longest way that a robot pushes an opponent", 0.05, 10)]
    stand_off_duration: Annotated[float, Quantity("s", "longest time that two opponents push each other", 1, 120)]
    outside_duration: Annotated[float, Quantity("s", "longest time of a robot wholly outside the lines", 0, 600)]
    charge_speed: Annotated[
        float, Quantity("m/s", "a robot that hits an opponent at a higher closing speed charges it", 0.5, 20)
    ] = 1.5
    charge_margin: Annotated[
        float,
        Quantity("m/s", "robots whose speeds toward each other differ by less are both or neither at fault", 0, 5),
    ] = 0.3
    charge_ball: Annotated[
        float, Quantity("m", "gap between hull and ball up to which a robot that hits an opponent plays the ball", 0, 2)
    ] = 0.3
    charge_card_speed: Annotated[
        float, Quantity("m/s", "a robot that drives faster into the opponent is shown a yellow card; 0: none", 0, 20)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class Scoring:
    """Which goals count, and which kicks from a team's own half are allowed."""

    pass_roll: Annotated[float, Quantity("m", "free roll of the ball that counts as a pass", 0, 10)]
    robots_touched: Annotated[
        int, Quantity("1", "robots of the taker's side that must touch the ball before a goal", 1, 11)
    ]
    lob_height: Annotated[float, Quantity("m", "apex of the ball's underside above which a kick is a lob", 0, 5)]
    lob_teammate: Annotated[float, Quantity("m", "a teammate this close to where it lands makes it a pass", 0, 20)]
    lob_robots: Annotated[int, Quantity("1", "least robots of its side on the field for a lob to be judged", 2, 11)]


@dataclass(frozen=True, slots=True)
class Scrum:
    """When a ball that both sides contest is dropped."""

    reach: Annotated[float, Quantity("m", "gap between hull and ball up to which a robot is at the ball", 0, 2)]
    progress: Annotated[float, Quantity("m", "a contested ball that moves this far makes progress", 0.05, 10)]
    duration: Annotated[float, Quantity("s", "longest time of both sides at the ball without progress", 1, 120)]


@dataclass(frozen=True, slots=True)
class Fouls:
    """Which fouls are called: `off`, `on`, or `yellow` for a restart and a yellow card; each named as its rule."""

    direct_goal: Annotated[str, Choice("a goal directly from the restart", CALLS)]
    own_half_goal: Annotated[
        str, Choice("a goal from the team's own half, or without a pass after winning the ball there", CALLS)
    ]
    dribble_circle: Annotated[str, Choice("dribbling out of the circle around the catch", CALLS)]
    backward: Annotated[str, Choice("driving backward with the ball", CALLS)]
    not_rolling: Annotated[str, Choice("moving a ball that does not roll", CALLS)]
    long_hold: Annotated[str, Choice("keeping the ball for too long", CALLS)]
    goal_area: Annotated[str, Choice("a robot other than the goalkeeper in a goal area", CALLS)]
    penalty_area: Annotated[str, Choice("too many robots in a penalty area", CALLS)]
    pushing: Annotated[str, Choice("pushing an opponent away", CALLS)]
    lob: Annotated[str, Choice("a lob from the team's own half that is not a pass", CALLS)]
    leaving_field: Annotated[str, Choice("leaving the field", CALLS)]
    charging: Annotated[str, Choice("driving into an opponent at speed", CALLS)] = "off"
    encroachment: Annotated[str, Choice("coming too near to a restart between START and the kick", CALLS)] = "off"
    penalty_kick: Annotated[str, Choice("leaving the places at a penalty before the kick", CALLS)] = "off"
