"""A rule book: the numbers of the rules as frozen data, read from TOML; the rules themselves live in the referee."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import resources
from typing import Annotated, Any

from schemas.config.foul_book import Areas, Contact, Fouls, Handling, Scoring, Scrum
from schemas.config.quantity import Quantity, merge_tables, read_section
from schemas.described import Described
from schemas.errors import TouchlineError, did_you_mean

SHIPPED = ("china-sim-2020", "friendly", "msl", "paper")
"""The rule books that come with the package."""


@dataclass(frozen=True, slots=True)
class Periods:
    """How a match is cut."""

    halves: Annotated[int, Quantity("1", "number of halves", 1, 2)]
    half_duration: Annotated[float, Quantity("s", "length of one half, unless the match file says another", 1, 7200)]
    half_time_break: Annotated[float, Quantity("s", "break between halves", 0, 1200)]
    parking: Annotated[float, Quantity("s", "time to park, after each half, before the break or the end", 0, 120)]
    needs_winner: Annotated[int, Quantity("1", "1: a level match goes on; the match file may say otherwise", 0, 1)]
    extra_halves: Annotated[int, Quantity("1", "halves of extra time; 0 for none", 0, 2)]
    extra_half_duration: Annotated[float, Quantity("s", "length of one of them; scaled as the halves are", 1, 7200)]
    shoot_out_kicks: Annotated[int, Quantity("1", "penalties of each side in a shoot-out; 0 for none", 0, 20)]
    shoot_out_series: Annotated[int, Quantity("1", "times that a shoot-out is played while it is level", 1, 10)]
    shoot_out_break: Annotated[float, Quantity("s", "break before a shoot-out", 0, 1200)]
    shoot_out_limit: Annotated[float, Quantity("s", "after START, a goal of the shoot-out falls within", 1, 120)]


@dataclass(frozen=True, slots=True)
class Restarts:
    """How the game goes on after a stop: STOP, ball placed, restart signal, START, ball in play."""

    stop_to_signal: Annotated[float, Quantity("s", "pause from STOP to the restart signal", 0, 60)]
    signal_to_start: Annotated[float, Quantity("s", "time to take positions, from the signal to START", 0, 60)]
    positions_limit: Annotated[float, Quantity("s", "START waits this long at most for robots that stand wrong", 0, 60)]
    time_limit: Annotated[float, Quantity("s", "after START, the ball is in play at the latest", 1, 60)]
    penalty_limit: Annotated[float, Quantity("s", "the same at a penalty: time to reach the ball", 1, 60)]
    in_play_distance: Annotated[float, Quantity("m", "the ball is in play after rolling freely this far", 0, 5)]
    drag_distance: Annotated[float, Quantity("m", "the taker may move the ball this far before its kick", 0, 10)]
    drop_robots_to_score: Annotated[int, Quantity("1", "robots that touch a dropped ball before a goal counts", 1, 2)]
    moves_offenders: Annotated[int, Quantity("1", "1: who stands wrong at the limit is moved; 0: is left there", 0, 1)]
    position_card: Annotated[int, Quantity("1", "1: who stands wrong at the limit gets a yellow card", 0, 1)]
    restart_fouls: Annotated[int, Quantity("1", "1: early, double and dragging touches are fouls; 0: not", 0, 1)]
    opponent_distance: Annotated[float, Quantity("m", "opponents stay this far from the ball, whole robot", 0, 10)]
    teammate_distance: Annotated[float, Quantity("m", "all but the kicker stay this far, whole robot", 0, 10)]
    drop_ball_distance: Annotated[float, Quantity("m", "everyone stays this far at a drop ball, whole robot", 0, 10)]
    touch_line_inset: Annotated[float, Quantity("m", "a throw-in is placed this far inside the touch line", 0, 2)]
    corner_inset: Annotated[float, Quantity("m", "a corner is placed this far inside both lines", 0, 2)]
    field_inset: Annotated[float, Quantity("m", "free kicks and dropped balls lie this far inside the lines", 0, 2)]
    drift: Annotated[float, Quantity("m", "before START, a ball that moved this far is put back", 0.01, 1)]


@dataclass(frozen=True, slots=True)
class Stall:
    """When a ball that nobody moves is dropped."""

    still_speed: Annotated[float, Quantity("m/s", "a ball slower than this does not move", 0, 2)]
    still_duration: Annotated[float, Quantity("s", "a ball still for this long is dropped", 1, 120)]


@dataclass(frozen=True, slots=True)
class Discipline:
    """What cards lead to; 0 switches a punishment off."""

    yellows_to_suspension: Annotated[int, Quantity("1", "yellow cards of one robot that suspend it", 0, 10)]
    suspension: Annotated[float, Quantity("s", "playing time that a suspended robot is off the field", 0, 1200)]
    yellows_to_red: Annotated[int, Quantity("1", "yellow cards of one robot that make a red one", 0, 10)]
    red_duration: Annotated[float, Quantity("s", "playing time off after a red card; 0: for good", 0, 1200)]
    red_growth: Annotated[float, Quantity("s", "that much more for each red card its side had before", 0, 600)]
    reds_to_removal: Annotated[
        int, Quantity("1", "with every so many reds of a side, its robot is out for good", 0, 20)
    ]
    reset_each_half: Annotated[int, Quantity("1", "1: yellow cards are forgotten at half time", 0, 1)]


@dataclass(frozen=True, slots=True)
class People:
    """Robots that leave and come back."""

    least_robots: Annotated[int, Quantity("1", "a side that cannot field this many forfeits; 0: never", 0, 5)]
    forfeit_goals: Annotated[int, Quantity("1", "goals by which a forfeited match is won at least", 0, 20)]
    repair: Annotated[float, Quantity("s", "a robot taken out for repair stays out this long", 0, 600)]
    repairs_at_once: Annotated[int, Quantity("1", "robots of a side in repair at the same time", 0, 5)]
    substitutions: Annotated[int, Quantity("1", "of a side in one match", 0, 20)]
    substitution: Annotated[float, Quantity("s", "from a robot's leaving to its substitute's coming", 0, 600)]
    silent_limit: Annotated[float, Quantity("s", "a robot whose program is gone is taken out; 0: never", 0, 600)]
    returns_per_stoppage: Annotated[int, Quantity("1", "robots of a side that come back in one stoppage", 1, 5)]


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
class RuleBook(Described):
    """The numbers that a match is refereed by."""

    name: str
    """Name of the rule book."""
    periods: Periods
    """Halves, breaks, extra time and penalty shoot-out."""
    restarts: Restarts
    """Distances and times of restarts."""
    discipline: Discipline
    """Cards and what follows from them."""
    people: People
    """Repairs, substitutions and forfeits."""
    stall: Stall
    """When a ball that no robot moves is dropped."""
    scrum: Scrum
    """When a ball that both sides contest is dropped."""
    scoring: Scoring
    """Which goals count, and which kicks from a team's own half are allowed."""
    handling: Handling
    """How robots may handle the ball."""
    areas: Areas
    """Who may be in goal areas and penalty areas, and for how long."""
    contact: Contact
    """How robots may touch each other."""
    fouls: Fouls
    """Which fouls are called."""
    origins: Mapping[str, str] = field(repr=False, compare=False)
    """`section.key` → where the number comes from."""


def rule_book_text(name: str) -> str:
    """The TOML of a rule book as it stands in its file."""
    if name not in SHIPPED:
        raise TouchlineError(f'rules is "{name}"; {did_you_mean(name, SHIPPED)}')
    return (resources.files("schemas") / "rule_books" / f"{name}.toml").read_text("utf-8")


def load_rule_book(name: str) -> RuleBook:
    """A shipped rule book by name.

    Raises:
        TouchlineError: no such rule book.
    """
    tables = tomllib.loads(rule_book_text(name))
    parent = tables.pop("extends", None)
    if parent is not None:
        tables = merge_tables(tomllib.loads(rule_book_text(parent)), tables)
    origins: dict[str, str] = {}
    sections: dict[str, Any] = {
        key: read_section(cls, tables.get(key, {}), f"{name}: {key}", origins) for key, cls in SECTIONS.items()
    }
    origins = {key.removeprefix(f"{name}: "): origin for key, origin in origins.items()}
    return RuleBook(name=name, origins=origins, **sections)
