"""How a running match stands, in one line."""

from collections import Counter

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
    losses = losses_words(view)
    if losses:
        parts.append(losses)
    return "  ".join(parts)


def robots_words(health: Health, total: int) -> str:
    """`robots 9/10 (silent: magenta3)`: who answers, or who is there while there is nothing to answer yet.

    Robots that stand still in the scene that is played have nobody who could answer.
    """
    playing = health.tick > 0
    moving = {name: robot for name, robot in health.robots.items() if not robot.still}
    silent = [name for name, robot in moving.items() if not (robot.answering if playing else robot.alive)]
    words = f"robots {len(moving) - len(silent)}/{total}"
    if not silent:
        return words
    return f"{words} ({'silent' if playing else 'missing'}: {', '.join(_few(silent))})"


def losses_words(view: MatchView) -> str:
    """`lost 12 (world 10, robot/cyan1/command 2)`: what the recorders miss, by key; empty where nothing is."""
    losses: Counter[str] = Counter()
    for progress in view.recorders.values():
        losses.update(progress.losses)
    if not losses:
        return ""
    keys = [f"{key} {count}" for key, count in losses.most_common()]
    return f"lost {losses.total()} ({', '.join(_few(keys))})"


def _few(names: list[str]) -> list[str]:
    return names if len(names) <= _NAMED else [*names[:_NAMED], f"{len(names) - _NAMED} more"]
