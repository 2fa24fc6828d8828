"""How the referee says places, restarts and touches in its sentences."""

from schemas.game import ActionName, Phase
from sim_host.referee.game.restart import Restart, Spot

HYPHENATED = frozenset({"kick_off", "throw_in"})
"""Names that people write with a hyphen."""


def display_name(name: Phase | ActionName) -> str:
    """A phase or an action in words."""
    return name.replace("_", "-" if name in HYPHENATED else " ")


def place_text(place: Spot) -> str:
    """A place in m with one decimal, without a minus before zero."""
    x, y = (round(value, 1) + 0.0 for value in place)
    return f"({x:.1f}, {y:.1f})"


def restart_text(restart: Restart) -> str:
    """A restart, for whom and where."""
    owner = f" for {restart.side}" if restart.side is not None else ""
    return f"{display_name(restart.phase)}{owner} at {place_text(restart.spot)}"


def last_touch_text(robot: str | None) -> str:
    """Who touched the ball last, as the end of a sentence."""
    return f"last touched by {robot}" if robot is not None else "touched by no robot since START"
