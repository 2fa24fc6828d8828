"""The worst matches of a plan: played again with a recording, and what they have in common."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from touchline.launch.terminal.aligned import counted
from touchline.matches.engine.outcome import Failed, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play_list import play_list

_TELLING = 0.25
"""Least difference between the shares of failures and of other matches in which an event is worth a line."""
_MOST = 5
"""Most events that are named."""


@dataclass(frozen=True, slots=True)
class Shared:
    """An event that failures have more often than other matches."""

    event: str
    failures: int
    """Failures in which it happened."""
    others: int
    """Other matches in which it happened."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A match that was played again with a recording."""

    label: str
    worth: float
    """What it was chosen by; the less, the worse."""
    recording: Path


@dataclass(frozen=True, slots=True)
class Failures:
    """The worst matches of a plan."""

    kept: list[Failure]
    """The worst first."""
    others: int
    """Matches that they are compared with."""
    shared: list[Shared]
    """What most tells them from the others first."""
    missing: list[str]
    """Sentences on matches that are not kept, because they were others when they were played again."""
    is_interrupted: bool
    """Whether Ctrl-C or SIGTERM came before the last one was played again."""

    @property
    def lines(self) -> list[str]:
        """For people: a line for each failure, and for each event that they share."""
        count = len(self.kept)
        lines = [f"  {one.label}: {one.worth:.6g}  {one.recording}" for one in self.kept]
        lines += [
            f"  {one.event}: in {one.failures} of {count} of them, in {one.others} of the {self.others} others"
            for one in self.shared
        ]
        failures = f"{counted(count, 'failure')}, the worst first:" if self.kept else "no failures"
        return [failures, *lines, *self.missing]


def keep_failures(
    planned: Sequence[PlannedMatch],
    outcomes: Mapping[str, Outcome],
    worth_of: Callable[[Played], float | None],
    most: int,
    folder: Path,
    jobs: int,
    bound: float | None = None,
    *,
    json: bool = False,
) -> Failures:
    """Play the `most` matches of least worth again, each with a recording in `folder`.

    Equal seeds give equal matches: a recording is of the very match that failed. Matches that were not played to their
    end, as where a brain raised, are left out: their traceback is known.

    Args:
        worth_of: what a match is judged by; None for one that shows no such figure.
        bound: a match of at least this worth is no failure; None for no bound.
    """
    played = {one.identity: outcome for one in planned if isinstance(outcome := outcomes.get(one.identity), Played)}
    worths = {identity: worth for identity, one in played.items() if (worth := worth_of(one)) is not None}
    matches = {one.identity: one for one in planned if one.identity in worths}
    order = sorted(matches.values(), key=lambda one: (worths[one.identity], one.config.seed))
    chosen = [one for one in order if bound is None or worths[one.identity] < bound][:most]
    again = [replace(one, recording=folder / (re.sub(r"\W+", "_", one.label) + ".mcap")) for one in chosen]
    repeated = play_list(again, jobs, "failures again, recorded", lambda one, _: one.label, json=json)
    kept, failures, missing = [], [], []
    for one in again:
        outcome, before = repeated.outcomes.get(one.identity), played[one.identity]
        if isinstance(outcome, Failed):
            missing.append(f"{one.label} failed when it was played again: {outcome.reason}")
        elif outcome is not None and outcome.chain != before.chain:
            missing.append(f"{one.label} was another match when it was played again; does its brain use a clock?")
        elif outcome is not None and one.recording is not None:
            kept.append(Failure(one.label, worths[one.identity], one.recording))
            failures.append(before)
    rest = [played[one.identity] for one in order if one not in chosen]
    return Failures(kept, len(rest), in_common(failures, rest), missing, repeated.is_interrupted)


def in_common(failures: Sequence[Played], others: Sequence[Played]) -> list[Shared]:
    """The events that happen in a clearly greater share of the failures than of the other matches; none without any."""
    if not failures or not others:
        return []
    found = []
    for event in sorted({event for one in failures for event in one.events}):
        failed, passed = (sum(event in each.events for each in group) for group in (failures, others))
        difference = failed / len(failures) - passed / len(others)
        if difference >= _TELLING:
            found.append((-difference, Shared(event, failed, passed)))
    return [one for _, one in sorted(found, key=lambda pair: (pair[0], pair[1].event))][:_MOST]
