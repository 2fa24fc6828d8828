"""The status of a running match, in one line."""

from collections import Counter

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.lines import state_line
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from schemas.messages.health import Health, RobotHealth
from touchline.launch.terminal.agent_faults import agent_faults
from touchline.launch.terminal.aligned import counted

_NAMED = 4
"""Maximum number of silent robots that are named; the rest is counted."""
_FAULTS = 2
"""Maximum number of agents whose fault is shown; the rest is counted."""


def status_line(follower: MatchFollower, total: int, names: TeamNames = SIDES_ALONE) -> str:
    """Clock, score, phase, speed, how many of `total` robots answer, and what is wrong with agents and recorders."""
    if follower.state is None and follower.health is None:
        return "waiting for the host"
    parts = [state_line(follower.state, names) if follower.state is not None else "waiting for the robots"]
    if follower.health is not None:
        if follower.health.tick > 0:
            parts.append(f"×{follower.health.real_time_factor:.1f}")
        parts.append(robots_text(follower.health, total))
        parts += _abbreviated([str(fault) for fault in agent_faults(follower.health)], _FAULTS)
    losses = losses_text(follower)
    if losses:
        parts.append(losses)
    return "  ".join(parts)


def robots_text(health: Health, total: int) -> str:
    """Robots that answer, as `robots 9/10 (silent: magenta3 57 ticks)`; before the first tick, those connected.

    Robots that stand still in the current scene have no agent, so they are not expected to answer.
    """
    playing = health.tick > 0
    moving = {name: robot for name, robot in health.robots.items() if not robot.still}
    silent = [
        f"{name}{_silence(robot) if playing else ''}"
        for name, robot in moving.items()
        if not (robot.answering if playing else robot.alive)
    ]
    text = f"robots {len(moving) - len(silent)}/{total}"
    if not silent:
        return text
    return f"{text} ({'silent' if playing else 'missing'}: {', '.join(_abbreviated(silent))})"


def _silence(robot: RobotHealth) -> str:
    """How long a robot has been silent; empty where the host does not report it."""
    count = robot.missed_in_a_row
    return f" {counted(count, 'tick')}" if count else ""


def losses_text(follower: MatchFollower) -> str:
    """Messages that the recorders miss, by key, as `lost 12 (world 10, robot/cyan1/command 2)`; empty if none."""
    losses: Counter[str] = Counter()
    for progress in follower.recorders.values():
        losses.update(progress.losses)
    if not losses:
        return ""
    keys = [f"{key} {count}" for key, count in losses.most_common()]
    return f"lost {losses.total()} ({', '.join(_abbreviated(keys))})"


def _abbreviated(names: list[str], most: int = _NAMED) -> list[str]:
    return names if len(names) <= most else [*names[:most], f"{len(names) - most} more"]
