"""Agents that do not keep up, or whose messages are no answers: each with its figure, and with a remedy."""

from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from schemas.config.match_config import LOCKSTEP
from schemas.messages.health import Health

_SLOW_MS = 100.0
"""Lockstep: longest wall time from sight to command that is not reported; brains that ship need a few milliseconds."""
_LASTING = 4
"""Reports of the host in a row, four in a second, after which slowness is no hiccup."""


class AgentFault(NamedTuple):
    """What is wrong with one agent."""

    robot: str
    text: str
    """The fault with its figure, such as `takes 310 ms a tick`."""
    is_slow: bool
    """The agent answers, but takes long."""

    def __str__(self) -> str:
        return f"{self.robot} {self.text}"


def agent_faults(health: Health) -> list[AgentFault]:
    """The agents with faults: those whose messages are no answers, then the slow ones, slowest first."""
    robots = [(name, one) for name, one in health.robots.items() if one.alive and not (one.removed or one.still)]
    faulty = [AgentFault(name, robot.fault, is_slow=False) for name, robot in robots if robot.fault]
    limit = _SLOW_MS if health.pace == LOCKSTEP else _tick_ms(health)
    slow = [(robot.latency_ms, name) for name, robot in robots if robot.latency_ms is not None and not robot.fault]
    late = sorted(((took, name) for took, name in slow if took > limit), reverse=True)
    return faulty + [AgentFault(name, f"takes {took:.0f} ms a tick", is_slow=True) for took, name in late]


def missed_sights(health: Health | None) -> dict[str, int]:
    """Robot → sights that it did not answer in a match in lockstep, by the host's last report on it."""
    if health is None or health.pace != LOCKSTEP:
        return {}
    return {name: robot.missed for name, robot in health.robots.items() if robot.missed}


def disturbance(missed: Mapping[str, int]) -> str:
    """Why a match in lockstep depends on more than its seed and its inputs, in one sentence; empty if it does not."""
    if not missed:
        return ""
    counts = ", ".join(f"{name} {count}" for name, count in missed.items())
    return f"the match does not depend on its seed alone: sights without an answer: {counts}"


class SlowAgents:
    """Finds agents that are slow for a while; each is reported once."""

    def __init__(self) -> None:
        self._reports: Counter[str] = Counter()

    def update(self, health: Health) -> list[str]:
        """Take in a report of the host; returns a sentence with a remedy for each agent that has become slow."""
        slow = {fault.robot: fault for fault in agent_faults(health) if fault.is_slow}
        for name in health.robots:
            if name in slow:
                self._reports[name] += 1
            elif self._reports[name] < _LASTING:
                self._reports[name] = 0
        return [f"{fault}, {_effect(health)}" for name, fault in slow.items() if self._reports[name] == _LASTING]


class InvalidAgents:
    """Finds agents whose messages are no commands; each is reported once."""

    def __init__(self) -> None:
        self._reported: set[str] = set()

    def update(self, health: Health) -> list[str]:
        """Take in a report of the host; returns a sentence for each agent whose first such messages it counts."""
        new = [name for name, robot in health.robots.items() if robot.invalid and name not in self._reported]
        self._reported.update(new)
        return [
            f"{name} sends messages that are no commands, {health.robots[name].invalid} so far; "
            "its log names them, and touchline health counts them"
            for name in new
        ]


def _tick_ms(health: Health) -> float:
    """Wall time of one tick at the pace of the match, in ms; infinite before the first."""
    speed = float(health.pace[1:]) if health.pace.startswith("x") else 1.0
    return 1e3 * health.time / health.tick / speed if health.tick else float("inf")


def _effect(health: Health) -> str:
    if health.pace == LOCKSTEP:
        return (
            f"the match runs at ×{health.real_time_factor:.1f}; make its act faster, or play with --pace realtime, "
            "where a late command misses its tick"
        )
    return f"a tick lasts {_tick_ms(health):.0f} ms, so its commands are late; make its act faster, or play in lockstep"
