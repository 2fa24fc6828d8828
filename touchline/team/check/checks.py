"""The table of checks: what each does, and its sentence where the contract is kept or broken."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from touchline.team.check import situations
from touchline.team.check.examination import (
    Examination,
    check_answers,
    check_build,
    check_limits,
    check_repeatable,
    check_situations,
    check_time,
    no_kick_when_stopped,
)
from touchline.team.check.subject import BreachError


@dataclass(frozen=True, slots=True)
class Check:
    """One check of the contract."""

    name: str
    does: str
    """What it does, for the list of checks."""
    kept: str
    """The sentence where the contract is kept; a template for the check's figures."""
    remedy: str
    """What to change where it is broken; empty where the sentence itself says it."""
    run: Callable[[Examination], dict[str, float]]
    """Returns figures; raises `BreachError` where the contract is broken."""
    is_needed: bool = False
    """Where it is broken, no further check can be judged."""


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The result of one check."""

    name: str
    kept: bool | None
    """None if it could not be judged, because of a fault that another check reports."""
    sentence: str = ""
    figures: dict[str, float] = field(default_factory=dict)


CHECKS = (
    Check(
        "build",
        "builds each robot of the team with its briefing",
        "all {robots:.0f} robots are built",
        "build a robot from its briefing alone",
        check_build,
        is_needed=True,
    ),
    Check(
        "answers",
        "plays two matches with equal seeds, in which each sight gets a valid command",
        "all {commands:.0f} sights are answered",
        "",
        check_answers,
        is_needed=True,
    ),
    Check(
        "time",
        "times each decision of these matches",
        "a decision takes {p50:.2f} ms (p50), {p99:.2f} ms (p99), {max:.2f} ms at most; a tick lasts {tick:.0f} ms",
        "make act faster: in real time a late command misses its tick",
        check_time,
    ),
    Check(
        "repeatable",
        "compares all commands of these matches",
        "two equal runs have the same {commands:.0f} commands",
        "seed all random numbers, and decide by sight.time, not by the clock of the machine",
        check_repeatable,
    ),
    Check(
        "limits",
        "compares all demands of a match with the limits of the robot, and counts refusals of the host",
        "all {commands:.0f} commands are within the limits, and none was refused",
        "limit demands to setup.drive and setup.kicker, and kick only while sight.holding and sight.kicker_ready",
        check_limits,
    ),
    Check(
        "ball_unseen",
        "gives sights without a ball, and with one that was seen long ago",
        "{sights:.0f} sights without a visible ball are answered",
        "sight.ball is None until the ball is seen, and sight.game.spot is None without a restart",
        check_situations(situations.ball_unseen),
    ),
    Check(
        "stopped",
        "gives sights before, after and between halves, and after STOP, with the ball at the robot",
        "{sights:.0f} sights of a game that does not run are answered without a kick",
        "kick only if sight.game.running",
        check_situations(situations.stopped, no_kick_when_stopped),
    ),
    Check(
        "sent_off",
        "gives sights of a robot that is off the field, and of one whose teammates are",
        "{sights:.0f} sights with robots off the field are answered",
        "answer every sight, also off the field: sight.game.robots names who does not take part",
        check_situations(situations.sent_off),
    ),
    Check(
        "set_pieces",
        "gives sights of each restart of both sides, before and after START",
        "{sights:.0f} sights of restarts are answered without a forbidden kick",
        "leave the ball alone before START, and until the opponents have taken their restart",
        check_situations(situations.set_pieces, no_kick_when_stopped),
    ),
    Check(
        "radio_fields",
        "gives messages of teammates that lack each field, or have unknown content",
        "{sights:.0f} sights with incomplete messages of teammates are answered",
        "every field of a radio message may be None, and extra may lack any name",
        check_situations(situations.radio_fields),
    ),
    Check(
        "twice",
        "gives each sight twice, leaves ticks out, and sets the world up anew",
        "{sights:.0f} sights that come again or after a gap are answered",
        "decide from the sight; a tick may come again, and ticks may be missing",
        check_situations(situations.repeated, times=2),
    ),
)
"""All checks, in the order in which they are run."""


def run_checks(examination: Examination) -> Iterator[CheckResult]:
    """Run all checks. Those that cannot be judged after a fault, or fail by an exception reported before, say so."""
    raised: set[str] = set()
    is_over = False
    for check in CHECKS:
        result = CheckResult(check.name, kept=None) if is_over else run_check(check, examination, raised)
        yield result
        is_over = is_over or (result.kept is False and (check.is_needed or examination.is_slow))


def run_check(check: Check, examination: Examination, raised: set[str] | None = None) -> CheckResult:
    """Run one check; `raised` has the exceptions that were reported, and gets those of this check."""
    raised = set() if raised is None else raised
    try:
        figures = check.run(examination)
    except BreachError as error:
        if error.raised and error.raised in raised:
            return CheckResult(check.name, kept=None)
        raised.add(error.raised)
        return CheckResult(check.name, kept=False, sentence="; ".join(filter(None, (str(error), check.remedy))))
    return CheckResult(check.name, kept=True, sentence=check.kept.format(**figures), figures=figures)
