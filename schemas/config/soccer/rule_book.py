"""A rule book: the numbers of the rules as frozen data, read from TOML. The rules themselves are in the referee.

The package ships those in `SHIPPED`; any other TOML file may extend one with `extends = "msl"` and change numbers. The
`version` of a shipped rule book is raised with every change of a number in it, or in one that it extends.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Annotated, Any

from schemas.config.number_files import HEADER, PROFILE_KEY, UNVERSIONED, NumberFiles, read_numbers
from schemas.config.quantity import Quantity
from schemas.config.roster import MAX_ROBOTS
from schemas.config.soccer.foul_book import Areas, Contact, Fouls, Handling, Scoring, Scrum
from schemas.errors import TouchlineError

SHIPPED = ("china-sim-2020", "eleven", "friendly", "msl", "msl-2016", "msl-2019", "paper")
"""The rule books that the package ships."""
FILES = NumberFiles("rules", "rule_books", SHIPPED)
"""Where rule books are read from."""


@dataclass(frozen=True, slots=True)
class Periods:
    """How a match is divided."""

    halves: Annotated[int, Quantity("1", "number of halves", 1, 2)]
    half_duration: Annotated[float, Quantity("s", "length of one half, unless the match file has a duration", 1, 7200)]
    half_time_break: Annotated[float, Quantity("s", "break between halves", 0, 1200)]
    parking: Annotated[float, Quantity("s", "time to park, after each half, before the break or the end", 0, 120)]
    needs_winner: Annotated[int, Quantity("1", "1: a level match continues; the match file can override it", 0, 1)]
    extra_halves: Annotated[int, Quantity("1", "halves of extra time; 0 for none", 0, 2)]
    extra_half_duration: Annotated[float, Quantity("s", "length of one of them; scaled like the halves", 1, 7200)]
    shoot_out_kicks: Annotated[int, Quantity("1", "penalties of each side in a shoot-out; 0 for none", 0, 20)]
    shoot_out_series: Annotated[int, Quantity("1", "most times that a level shoot-out is played", 1, 10)]
    shoot_out_break: Annotated[float, Quantity("s", "break before a shoot-out", 0, 1200)]
    shoot_out_limit: Annotated[float, Quantity("s", "time after START for a goal of the shoot-out", 1, 120)]


@dataclass(frozen=True, slots=True)
class Restarts:
    """How the game continues after a stop: STOP, ball placed, restart signal, START, ball in play."""

    stop_to_signal: Annotated[float, Quantity("s", "pause from STOP to the restart signal", 0, 60)]
    signal_to_start: Annotated[float, Quantity("s", "time to take positions, from the signal to START", 0, 60)]
    positions_limit: Annotated[
        float, Quantity("s", "longest wait of START after the signal, for robots in illegal positions", 0, 60)
    ]
    time_limit: Annotated[float, Quantity("s", "latest time after START for the ball to be in play", 1, 60)]
    penalty_limit: Annotated[float, Quantity("s", "the same at a penalty: time to reach the ball", 1, 60)]
    in_play_distance: Annotated[float, Quantity("m", "the ball is in play after rolling freely this far", 0, 5)]
    drag_distance: Annotated[float, Quantity("m", "the taker may move the ball this far before its kick", 0, 10)]
    drop_robots_to_score: Annotated[int, Quantity("1", "robots that touch a dropped ball before a goal counts", 1, 2)]
    moves_offenders: Annotated[
        int, Quantity("1", "1: a robot in an illegal position at the limit is moved; 0: not", 0, 1)
    ]
    position_card: Annotated[
        int, Quantity("1", "1: a robot in an illegal position at the limit gets a yellow card", 0, 1)
    ]
    restart_fouls: Annotated[int, Quantity("1", "1: early, double and dragging touches are fouls; 0: not", 0, 1)]
    opponent_distance: Annotated[float, Quantity("m", "opponents stay this far from the ball, whole robot", 0, 10)]
    teammate_distance: Annotated[float, Quantity("m", "all but the kicker stay this far, whole robot", 0, 10)]
    drop_ball_distance: Annotated[float, Quantity("m", "all robots stay this far at a drop ball, whole robot", 0, 10)]
    touch_line_inset: Annotated[float, Quantity("m", "a throw-in is placed this far inside the touch line", 0, 2)]
    corner_inset: Annotated[float, Quantity("m", "a corner is placed this far inside both lines", 0, 2)]
    field_inset: Annotated[
        float, Quantity("m", "free kicks and dropped balls are placed this far inside the lines", 0, 2)
    ]
    drift: Annotated[float, Quantity("m", "before START, a ball that moved this far is placed again", 0.01, 1)]
    encroach_margin: Annotated[
        float,
        Quantity("m", "between START and the kick, a robot nearer than allowed by more than this encroaches", 0, 2),
    ] = 0.2
    encroach_retreat: Annotated[
        float, Quantity("s", "time to retreat for a robot that was too near at START or was pushed there", 0, 60)
    ] = 2.0
    advantage: Annotated[
        float,
        Quantity("s", "time that play goes on for a side that keeps the ball after a foul; 0: no advantage", 0, 30),
    ] = 0.0
    penalty_behind: Annotated[
        int, Quantity("1", "1: at a penalty all but kicker and goalkeeper stay behind the ball; 0: not", 0, 1)
    ] = 0


@dataclass(frozen=True, slots=True)
class Stall:
    """When a ball that lies still or makes no progress is dropped."""

    still_speed: Annotated[float, Quantity("m/s", "a slower ball counts as still", 0, 2)]
    still_duration: Annotated[float, Quantity("s", "a ball still for this long is dropped", 1, 120)]
    progress_distance: Annotated[
        float, Quantity("m", "a ball that leaves a circle of this radius makes progress", 0.5, 20)
    ] = 3.0
    progress_duration: Annotated[float, Quantity("s", "longest time of a ball in play without progress", 1, 120)] = 10.0


@dataclass(frozen=True, slots=True)
class Discipline:
    """The consequences of cards; 0 disables a punishment."""

    yellows_to_suspension: Annotated[int, Quantity("1", "yellow cards of one robot that suspend it", 0, 10)]
    suspension: Annotated[
        float, Quantity("s", "time between START and STOP that a suspended robot is off the field", 0, 1200)
    ]
    yellows_to_red: Annotated[int, Quantity("1", "yellow cards of one robot that count as a red one", 0, 10)]
    red_duration: Annotated[
        float,
        Quantity(
            "s", "time between START and STOP off the field after a red card; 0: for the rest of the match", 0, 1200
        ),
    ]
    red_growth: Annotated[float, Quantity("s", "additional time for each earlier red card of its side", 0, 600)]
    reds_to_removal: Annotated[
        int, Quantity("1", "with each such number of red cards of a side, the robot is out for the match", 0, 20)
    ]
    reset_each_half: Annotated[int, Quantity("1", "1: yellow cards and repeated fouls are cleared at half time", 0, 1)]
    repeated_encroachment: Annotated[
        int, Quantity("1", "encroachments of one robot from which on each is a yellow card; 0: none", 0, 20)
    ] = 0
    repeated_fouls: Annotated[
        int, Quantity("1", "fouls of one kind by one robot from which on each is a yellow card; 0: none", 0, 20)
    ] = 0


@dataclass(frozen=True, slots=True)
class People:
    """How many robots a side has, and how they leave and return."""

    least_robots: Annotated[int, Quantity("1", "a side that cannot field as many robots forfeits; 0: never", 0, 11)]
    forfeit_goals: Annotated[int, Quantity("1", "goals of a forfeit, to none; the winner keeps a greater lead", 0, 20)]
    repair: Annotated[float, Quantity("s", "time off the field of a robot in repair", 0, 600)]
    repairs_at_once: Annotated[int, Quantity("1", "robots of a side in repair at the same time", 0, 11)]
    substitutions: Annotated[int, Quantity("1", "substitutions of a side in one match", 0, 20)]
    substitution: Annotated[float, Quantity("s", "time from a robot's leaving to its substitute's entry", 0, 600)]
    silent_limit: Annotated[
        float, Quantity("s", "time after which a robot without a program is taken off the field; 0: never", 0, 600)
    ]
    returns_per_stoppage: Annotated[int, Quantity("1", "robots of a side that return in one stoppage", 1, 11)]
    most_robots: Annotated[int, Quantity("1", "robots of a side in a match, at most", 1, MAX_ROBOTS)] = 5
    entry_rows: Annotated[int, Quantity("1", "rows of places at the touch line where robots come back", 1, 5)] = 1


SECTIONS: dict[str, type] = {
    "periods": Periods,
    "restarts": Restarts,
    "discipline": Discipline,
    "people": People,
    "stall": Stall,
    "scrum": Scrum,
    "scoring": Scoring,
    "handling": Handling,
    "areas": Areas,
    "contact": Contact,
    "fouls": Fouls,
}
"""Section name in the file → the dataclass that holds it."""


@dataclass(frozen=True, slots=True)
class RuleBook:
    """The numbers that the referee applies."""

    name: str
    """Name of the rule book."""
    periods: Periods
    """Halves, breaks, extra time and penalty shoot-out."""
    restarts: Restarts
    """Distances and times of restarts."""
    discipline: Discipline
    """Cards and their consequences."""
    people: People
    """Sizes of the sides, repairs, substitutions and forfeits."""
    stall: Stall
    """When a ball that lies still or makes no progress is dropped."""
    scrum: Scrum
    """When a ball that both sides contest is dropped."""
    scoring: Scoring
    """Which goals count, and which kicks from a team's own half are allowed."""
    handling: Handling
    """How robots may handle the ball."""
    areas: Areas
    """Which robots may be in goal areas and penalty areas, and for how long."""
    contact: Contact
    """How robots may touch each other."""
    fouls: Fouls
    """Which fouls are called."""
    origins: Mapping[str, str] = field(repr=False, compare=False)
    """`section.key` → origin of the number."""
    version: int = UNVERSIONED
    """Version of the numbers; 0 for a file without one."""
    profile: str | None = None
    """Name of the profile whose pitch the rule book describes; None for a rule book that describes none."""


def load_rule_book(name: str) -> RuleBook:
    """A shipped rule book by name, or one from a path that ends in `.toml`.

    Raises:
        TouchlineError: there is no such rule book, or it is invalid.
    """
    return shipped_rule_book(name) if name in FILES.shipped else rule_book_of(name, FILES.tables(name))


@cache
def shipped_rule_book(name: str) -> RuleBook:
    """A shipped rule book, which is read once."""
    return rule_book_of(name, FILES.tables(name))


def rule_book_of(name: str, tables: Mapping[str, Any]) -> RuleBook:
    """The rule book of these tables, as `FILES.tables` returns them.

    Raises:
        TouchlineError: they are invalid.
    """
    sections, origins, version = read_numbers(name, tables, SECTIONS, HEADER)
    profile = tables.get(PROFILE_KEY)
    if profile is not None and not isinstance(profile, str):
        raise TouchlineError(f'{name}: profile is {profile!r}; write the name of a profile, profile = "msl"')
    return RuleBook(name=name, origins=origins, version=version, profile=profile, **sections)
