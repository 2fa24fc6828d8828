"""The state of a cup: its schedule with the matches that are over, those that can be played, and those that failed."""

import hashlib
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from enum import StrEnum

from touchline.matches.cup.cup_config import CupConfig
from touchline.matches.cup.formats.knock_out import Vacancy
from touchline.matches.cup.match_result import Fixture, FixtureResult, MatchResult
from touchline.matches.cup.schedule import Schedule, schedule_of

ADMISSION = "admission"
"""The stage before the cup: each team plays a short match against itself, and who fails in it is refused."""


@dataclass(frozen=True, slots=True)
class Slot:
    """One match of a fixture: what the cup decides before it is played."""

    fixture: Fixture
    leg: int
    """Place in the fixture, from 0."""

    @property
    def name(self) -> str:
        """Unique in the cup: `league 3`, or `final, match 2`."""
        return self.fixture.name if self.fixture.best_of == 1 else f"{self.fixture.name}, match {self.leg + 1}"

    @property
    def file_name(self) -> str:
        """The name for files and addresses: `final_match_2`."""
        return re.sub(r"\W+", "_", self.name.lower())

    @property
    def is_admission(self) -> bool:
        """Whether a team plays against itself, before the cup."""
        return self.fixture.stage == ADMISSION

    @property
    def sides(self) -> tuple[str, str]:
        """The teams in cyan and in magenta."""
        return self.fixture.sides(self.leg)

    def seed(self, cup: CupConfig) -> int:
        """Seed of the match: it depends on the cup's seed and the name of the match alone."""
        digest = hashlib.blake2b(f"{cup.seed} {self.name}".encode(), digest_size=4).digest()
        return int.from_bytes(digest, "big") >> 1


class MatchState(StrEnum):
    """How far a match is."""

    DUE = "due"
    PLAYED = "played"
    FORFEITED = "forfeited"
    FAILED = "failed"
    """It was not played to its end, and neither team is to blame: it has no result."""


@dataclass(frozen=True, slots=True)
class Ended:
    """How a match ended."""

    result: MatchResult | None
    """None for a match that failed through the fault of neither team."""
    identity: str = ""
    """Digest of all that determines the match."""
    reason: str | None = None
    """Why it was forfeited or failed, or what else than its seed it depends on."""
    recording: str | None = None
    """The path of its recording in the folder of the cup."""
    evidence: str | None = None
    """The path of the evidence for its reason, in the folder of the cup."""
    chain: str | None = None
    """The hash chain over all states."""

    @property
    def state(self) -> MatchState:
        """How far the match is."""
        if self.result is None:
            return MatchState.FAILED
        return MatchState.PLAYED if not self.result.forfeited_by else MatchState.FORFEITED


@dataclass(frozen=True, slots=True)
class CupMatch:
    """A match of the cup, and how it ended."""

    slot: Slot
    ended: Ended | None = None

    @property
    def state(self) -> MatchState:
        """How far the match is."""
        return self.ended.state if self.ended is not None else MatchState.DUE

    @property
    def result(self) -> MatchResult | None:
        """Its result; None before it is over."""
        return self.ended.result if self.ended is not None else None


EndedOf = Callable[[Slot], Ended | None]
"""How a match ended; None while it is not over."""


@dataclass(frozen=True, slots=True)
class CupState:
    """A cup as far as it is known."""

    cup: CupConfig
    schedule: Schedule
    fixtures: dict[str, FixtureResult] = field(default_factory=dict)
    """Name → the fixture with its matches that are over."""
    matches: tuple[CupMatch, ...] = ()
    """All matches that are certain to be played, in order."""

    @property
    def due(self) -> list[Slot]:
        """Matches that can be played now: those of the cup when all admissions are over."""
        due = [one.slot for one in self.matches if one.state is MatchState.DUE]
        return [slot for slot in due if slot.is_admission] or due

    @property
    def refused(self) -> set[str]:
        """Teams that failed in their admission."""
        return _refused(self.matches)

    @property
    def failed(self) -> list[CupMatch]:
        """Matches without a result."""
        return [one for one in self.matches if one.state is MatchState.FAILED]

    @property
    def is_complete(self) -> bool:
        """Whether all matches have a result."""
        return all(one.result is not None for one in self.matches)

    @property
    def disturbed(self) -> list[CupMatch]:
        """Matches that were played, and depend on more than their seeds."""
        return [one for one in self.matches if one.state is MatchState.PLAYED and one.ended and one.ended.reason]

    @property
    def results(self) -> list[MatchResult]:
        """Results of all matches between two teams that are over."""
        return [one.result for one in self.matches if one.result is not None and not one.slot.is_admission]

    @property
    def winner(self) -> str | None:
        """The winner of the cup; None before it is known, and where no team was admitted."""
        if not self.is_complete:
            return None
        bracket = self.schedule.bracket
        if bracket is not None:
            return None if isinstance(bracket.winner, Vacancy) else bracket.winner
        ((row, *_),) = self.schedule.tables.values()
        return None if row.team in self.refused else row.team


def state_of(cup: CupConfig, ended_of: EndedOf) -> CupState:
    """The state of a cup, from how its matches have ended: a pure function of it."""
    first = [
        Slot(Fixture(f"{ADMISSION} {place}", ADMISSION, 1, (name, name)), 0) for place, name in enumerate(cup.names, 1)
    ]
    admissions = [CupMatch(slot, ended_of(slot)) for slot in first]
    fixtures: dict[str, FixtureResult] = {}
    while True:
        schedule = schedule_of(cup, fixtures, _refused(admissions))
        new = [one for one in schedule.fixtures if one.name not in fixtures]
        if not new:
            matches = [match for one in schedule.fixtures for match in _matches_of(fixtures[one.name], ended_of)]
            return CupState(cup, schedule, fixtures, (*admissions, *matches))
        fixtures |= {one.name: _result_of(one, ended_of) for one in new}


def _refused(matches: Iterable[CupMatch]) -> set[str]:
    return {one.slot.sides[0] for one in matches if one.slot.is_admission and one.state is MatchState.FORFEITED}


def _result_of(fixture: Fixture, ended_of: EndedOf) -> FixtureResult:
    """The matches of a fixture with a result, as far as all before them have one."""
    result = FixtureResult(fixture)
    while result.legs_to_play:
        ended = ended_of(Slot(fixture, len(result.matches)))
        if ended is None or ended.result is None:
            break
        result = FixtureResult(fixture, (*result.matches, ended.result))
    return result


def _matches_of(result: FixtureResult, ended_of: EndedOf) -> list[CupMatch]:
    legs = len(result.matches) + len(result.legs_to_play)
    slots = [Slot(result.fixture, leg) for leg in range(legs)]
    return [CupMatch(slot, ended_of(slot)) for slot in slots]
