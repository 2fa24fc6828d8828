"""Plays a cup: what is due is played, each outcome is stored at once, and the pages follow."""

from collections.abc import Callable
from contextlib import closing
from importlib.metadata import version
from pathlib import Path

from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.tournament.cup_config import CupConfig
from touchline.tournament.cup_state import CupState, Ended, Slot, state_of
from touchline.tournament.match_result import MatchResult, Pair
from touchline.tournament.playing.outcome import FailureKind, Outcome
from touchline.tournament.playing.planned_match import PlannedMatch, digest_of, match_config, plan_match
from touchline.tournament.playing.store import CupStore
from touchline.tournament.playing.worker import Workers
from touchline.tournament.site.write_site import Site

Report = Callable[[CupState, Slot, Ended], None]
"""Called with each match that has ended."""


class CupRun:
    """A cup that is played in a folder; to be closed."""

    def __init__(self, cup: CupConfig, code_folder: Path, folder: Path, *, resume: bool) -> None:
        """Begin a cup, or go on with the one of the folder.

        Raises:
            TouchlineError: a team or a key is invalid; the folder has a cup already, or another one.
        """
        self._cup, self._code_folder, self._folder = cup, code_folder, folder
        digests = {team.name: digest_of(cup, team, code_folder) for team in cup.teams}
        for slot in state_of(cup, lambda _: None).due[:1]:
            match_config(cup, slot)
        self._store = CupStore(folder, writes=True)
        try:
            self._begin(digests, resume=resume)
        except BaseException:
            self._store.close()
            raise
        self._digests = digests
        self._site = Site(folder, digests)

    def close(self) -> None:
        """Free the folder."""
        self._store.close()

    @property
    def state(self) -> CupState:
        """How far the cup is."""
        return stored_state(self._cup, self._store)

    def play(self, jobs: int, report: Report) -> CupState:
        """Play all matches that have no outcome yet; pages are written after each."""
        state = self.state
        self._site.write(state, running=True)
        try:
            with closing(Workers(jobs, self._cup.hang)) as workers:
                while self._start(workers, state):
                    for planned, outcome in workers.ended():
                        self._store.add(planned.slot.name, planned.identity, outcome)
                        state = self.state
                        ended = ended_of(self._cup, planned.slot, planned.identity, outcome)
                        self._site.write(state, running=True)
                        report(state, planned.slot, ended)
        finally:
            self._site.write(state, running=False)
        return state

    def _start(self, workers: Workers, state: CupState) -> bool:
        """Start matches while there is room; returns whether any is played."""
        names = {planned.slot.name for planned in workers.running}
        for slot in state.due:
            if slot.name not in names and workers.has_room:
                workers.start(self._planned(slot))
        return bool(workers.running)

    def _planned(self, slot: Slot) -> PlannedMatch:
        return plan_match(self._cup, slot, self._code_folder, self._folder, self._digests)

    def _begin(self, digests: dict[str, str], *, resume: bool) -> None:
        stored = self._store.cup
        if stored is None:
            self._store.begin(self._cup, digests, version("touchline"))
            return
        if not resume:
            raise TouchlineError(f"{self._folder}: has a cup already; add --resume to go on, or give another --out")
        if stored != self._cup:
            raise TouchlineError(f"{self._folder}: its cup is another one than that of the file; give another --out")
        for team, digest in self._store.digests.items():
            if digests[team] != digest:
                raise TouchlineError(
                    f'the files of team "{team}" have changed since the cup began; restore them, or give another --out'
                )
        self._store.forget_not_played()


def stored_state(cup: CupConfig, store: CupStore) -> CupState:
    """How far a stored cup is."""
    outcomes = store.outcomes

    def ended(slot: Slot) -> Ended | None:
        found = outcomes.get(slot.name)
        return ended_of(cup, slot, *found) if found is not None else None

    return state_of(cup, ended)


def ended_of(cup: CupConfig, slot: Slot, identity: str, outcome: Outcome) -> Ended:
    """How a match ended, in the order of the teams of its fixture."""
    recording, evidence = f"recordings/{slot.file_name}.mcap", f"evidence/{slot.file_name}"
    if outcome.failure is None:
        return Ended(_result(slot, outcome), identity, recording=recording, chain=outcome.chain)
    if outcome.culprit is None or outcome.failure is FailureKind.WORKER:
        return Ended(None, identity, outcome.reason)
    culprit = slot.sides[tuple(Side).index(outcome.culprit)]
    goals = cup.match_config().load_rule_book().people.forfeit_goals
    first, second = slot.fixture.teams
    result = MatchResult((first, second), (0, goals) if culprit == first else (goals, 0), forfeited_by=culprit)
    reason = f"{culprit} {outcome.failure}: {outcome.reason}"
    return Ended(result, identity, reason, evidence=evidence)


def _result(slot: Slot, outcome: Outcome) -> MatchResult:
    """The result in the order of the fixture; outcomes are in the order of the sides."""
    turned = slot.sides != slot.fixture.teams

    def ordered(pair: Pair) -> Pair:
        return pair[::-1] if turned else pair

    penalties = ordered(outcome.penalties) if outcome.penalties is not None else None
    return MatchResult(
        slot.fixture.teams, ordered(outcome.goals), penalties, ordered(outcome.yellows), ordered(outcome.reds)
    )
