"""The parts of checks: time of decisions, two equal runs, limits, and situations."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from statistics import fmean

from runtime.process.clock import Clock, WallClock
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from touchline.team.check.play import Played, play_checked
from touchline.team.check.situations import NamedSight, over_time
from touchline.team.check.subject import BreachError, Subject

DEFAULT_SECONDS = 12.0
"""Simulated time of a match of a check."""
_MOST_SHOWN = 3
"""Examples of a fault that a sentence has."""


@dataclass
class Examination:
    """One subject while it is checked; the matches that several checks look at are played once."""

    subject: Subject
    seconds: float = DEFAULT_SECONDS
    clock: Clock = field(default_factory=WallClock)

    @cached_property
    def played(self) -> Played:
        """The first match.

        Raises:
            BreachError: the contract is broken in it.
        """
        return play_checked(self.subject, self.seconds, self.clock)

    @cached_property
    def played_again(self) -> Played:
        """A second match with equal seeds and new brains.

        Raises:
            BreachError: the contract is broken in it.
        """
        return play_checked(self.subject, self.seconds, self.clock)

    @property
    def matches(self) -> list[Played]:
        """Both matches; the first alone if its decisions take so long that it was ended early.

        Raises:
            BreachError: the contract is broken in them.
        """
        return [self.played] if self.played.is_slow else [self.played, self.played_again]

    @property
    def is_slow(self) -> bool:
        """Whether a match was ended because decisions take longer than their ticks."""
        return self.matches[-1].is_slow


def check_build(examination: Examination) -> dict[str, float]:
    """Build each robot of the team once."""
    setup = examination.subject.setup()
    for robot in examination.subject.robots:
        examination.subject.start(robot, setup).close()
    return {"robots": len(examination.subject.robots)}


def check_answers(examination: Examination) -> dict[str, float]:
    """Play two matches with equal seeds and new brains; the second only if the brains are fast enough."""
    return {"commands": sum(len(played.decisions) for played in examination.matches)}


def check_time(examination: Examination) -> dict[str, float]:
    """Compare the time of decisions with the control tick; of two equal runs, the shorter time of each decision.

    So a machine that is busy otherwise does not count. The first decision of a robot, before the game begins, does
    not count either: a program is still starting.
    """
    tick = examination.subject.setup().time.tick * 1e3
    if examination.is_slow:
        mean = fmean(one.seconds for one in examination.matches[-1].decisions if one.tick > 0) * 1e3
        raise BreachError(f"a decision takes {mean:.1f} ms on average, and a tick lasts {tick:.0f} ms")
    runs = zip(examination.played.decisions, examination.played_again.decisions, strict=True)
    took = sorted(min(one.seconds, other.seconds) * 1e3 for one, other in runs if one.tick > 0)
    figures = {
        "p50": took[len(took) // 2],
        "p99": took[math.ceil(0.99 * len(took)) - 1],
        "max": took[-1],
        "tick": tick,
        "decisions": float(len(took)),
    }
    if figures["p99"] > figures["tick"]:
        slow = figures["p99"]
        raise BreachError(f"one decision in a hundred takes {slow:.1f} ms or more, and a tick lasts {tick:.0f} ms")
    return figures


def check_repeatable(examination: Examination) -> dict[str, float]:
    """Play the match twice with equal seeds and new brains, and compare all commands."""
    first, second = examination.played, examination.played_again
    for one, other in zip(first.decisions, second.decisions, strict=True):
        if one.payload != other.payload:
            raise BreachError(
                f"{one.robot} decides differently at tick {one.tick} of two equal runs: "
                f"{_shortened(one.payload)}, then {_shortened(other.payload)}"
            )
    return {"commands": len(first.decisions)}


def check_limits(examination: Examination) -> dict[str, float]:
    """Compare the demands of a match with the limits of the robots, and count what the host refuses."""
    played = examination.played
    faults = played.excesses or played.refusals
    if faults:
        more = f"; {len(faults) - _MOST_SHOWN} more" if len(faults) > _MOST_SHOWN else ""
        raise BreachError("; ".join(faults[:_MOST_SHOWN]) + more)
    return {"commands": len(played.decisions)}


Situations = Callable[[Sight, Setup], Iterator[NamedSight]]
Rule = Callable[[Command, Sight], str]
"""What a command does that its sight forbids; empty if nothing."""


def check_situations(
    situations: Situations, rule: Rule = lambda _command, _sight: "", *, times: int = 1
) -> Callable[[Examination], dict[str, float]]:
    """Give each robot the sights of these situations, each sight `times` times, and apply a rule to its commands.

    Without a rule every valid command is allowed.
    """

    def check(examination: Examination) -> dict[str, float]:
        subject, setup = examination.subject, examination.subject.setup()
        asked = 0
        for name, sight in examination.played.sights.items():
            robot = subject.start(name, setup)
            try:
                for situation, made in over_time(situations(sight, setup), setup.time.tick):
                    for _ in range(times):
                        asked += 1
                        _ask(robot.act, situation, made, rule, name)
            finally:
                robot.close()
        return {"sights": asked}

    return check


def _ask(act: Callable[[Sight], Command], situation: str, sight: Sight, rule: Rule, robot: str) -> None:
    try:
        command = act(sight)
    except BreachError as error:
        raise BreachError(f"{situation}: {error}", error.raised) from None
    if broken := rule(command, sight):
        raise BreachError(f"{situation}: {robot} {broken}")


def no_kick_when_stopped(command: Command, sight: Sight) -> str:
    """No kick while the game does not run, or before the opponents' restart is in play."""
    game = sight.game
    if command.kick is None or (game.running and not game.phase.theirs):
        return ""
    return "kicks the ball" if game.running else "kicks the ball although the game does not run"


def _shortened(payload: bytes) -> str:
    text = payload.decode()
    return text if len(text) <= 100 else f"{text[:100]}…"
