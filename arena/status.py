"""How a running match stands, in one line."""

from coach_gateway.lines import state_line
from coach_gateway.view import MatchView
from schemas.host import Health

_NAMED = 4
"""So many silent robots are named; more are counted."""


def status_line(view: MatchView, total: int) -> str:
    """Clock, score, phase, speed, and how many of `total` robots answer."""
    if view.state is None and view.health is None:
        return "waiting for the host"
    parts = [state_line(view.state) if view.state is not None else "waiting for everybody"]
    if view.health is not None:
        if view.health.tick > 0:
            parts.append(f"×{view.health.real_time_factor:.1f}")
        parts.append(robots_words(view.health, total))
    return "  ".join(parts)


def robots_words(health: Health, total: int) -> str:
    """`robots 9/10 (silent: magenta3)`: who answers, or who is there while there is nothing to answer yet."""
    playing = health.tick > 0
    silent = [name for name, robot in health.robots.items() if not (robot.answering if playing else robot.alive)]
    words = f"robots {len(health.robots) - len(silent)}/{total}"
    if not silent:
        return words
    return f"{words} ({'silent' if playing else 'missing'}: {', '.join(_few(silent))})"


def _few(names: list[str]) -> list[str]:
    return names if len(names) <= _NAMED else [*names[:_NAMED], f"{len(names) - _NAMED} more"]
