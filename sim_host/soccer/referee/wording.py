"""Texts for places, restarts and touches in the referee's events."""

from collections.abc import Sequence

from schemas.soccer.game import ActionName, Phase
from sim_host.soccer.referee.game.restart import Restart, Spot

HYPHENATED = frozenset({"kick_off", "throw_in"})
"""Names that people write with a hyphen."""


def display_name(name: Phase | ActionName) -> str:
    """The name of a phase or an action, as people write it."""
    return name.replace("_", "-" if name in HYPHENATED else " ")


def place_text(place: Spot) -> str:
    """A place in m with one decimal; zero has no minus sign."""
    x, y = (round(value, 1) + 0.0 for value in place)
    return f"({x:.1f}, {y:.1f})"


def restart_text(restart: Restart) -> str:
    """A restart with its side and its place."""
    owner = f" for {restart.side}" if restart.side is not None else ""
    return f"{display_name(restart.phase)}{owner} at {place_text(restart.spot)}"


def last_touch_text(robot: str | None) -> str:
    """The robot that touched the ball last, as the end of a sentence."""
    return f"last touched by {robot}" if robot is not None else "touched by no robot since START"


def level_touch_text(robots: Sequence[str]) -> str:
    """Robots that touched the ball last at the same time, as the end of a sentence."""
    return f"last touched by {' and '.join(robots)} at the same time and equally hard"
