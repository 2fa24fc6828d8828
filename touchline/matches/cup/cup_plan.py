"""A cup as a plan of matches: which are due follows from the outcomes so far, and how each counts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from schemas.config.config_model import ConfigModel
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import TeamConfig, TeamConfigs
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from schemas.side import Side
from schemas.soccer.game import Card
from touchline.launch.terminal.agent_faults import disturbance
from touchline.matches.cup.cup_config import CupConfig, TeamEntry
from touchline.matches.cup.cup_state import CupState, Ended, Slot, state_of
from touchline.matches.cup.match_result import MatchResult, Pair
from touchline.matches.engine.code_digest import code_digest
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.store import RunStore

RECORDINGS, LOGS = "recordings", "logs"
"""Folders in a cup's folder: a recording of each match; logs of processes, and tracebacks."""
ADMISSION_S = 60.0
"""The longest playing time of the match that a team plays before the cup, in s."""
_DOCUMENT = "cup"
"""Name of the document of a run that has its cup."""
_FORFEITS = {
    FailureKind.DID_NOT_START: "did not start",
    FailureKind.CRASHED: "crashed",
    FailureKind.HUNG: "hung",
    FailureKind.BROKE_ACCESS_RULES: "broke the access rules",
}
"""Failures for which a team forfeits, in words."""


@dataclass(frozen=True)
class CupPlan:
    """The plan of a cup in a folder."""

    cup: CupConfig
    code_folder: Path
    """Where brains and programs are looked for first: the folder of the cup file."""
    folder: Path
    """The folder of the cup, an absolute path."""
    digests: Mapping[str, str]
    """Team → digest of its files."""
    files: Mapping[str, Any] | None = None
    """Scene, profile and rule book, as `CupConfig.read_files` has read them; None to read them now."""
    _matches: dict[Slot, PlannedMatch] = field(default_factory=dict, init=False, compare=False, repr=False)
    """Slot → match; its identity is computed once."""

    @cached_property
    def forfeit_goals(self) -> int:
        """Goals of a forfeit, by the rule book."""
        return self.cup.match_config(self.files).load_rule_book().people.forfeit_goals

    def due(self, outcomes: Mapping[str, Outcome]) -> Sequence[PlannedMatch]:
        """The matches that can be played now."""
        return [self.match(slot) for slot in self.state(outcomes).due]

    def state(self, outcomes: Mapping[str, Outcome]) -> CupState:
        """How far the cup is."""

        def ended(slot: Slot) -> Ended | None:
            outcome = outcomes.get(self.match(slot).identity)
            return self.ended(slot, outcome) if outcome is not None else None

        return state_of(self.cup, ended)

    def match(self, slot: Slot) -> PlannedMatch:
        """The match of a slot.

        Raises:
            TouchlineError: a team is none that ships, or a key of the match is invalid.
        """
        if slot not in self._matches:
            self._matches[slot] = PlannedMatch(
                config=match_config(self.cup, slot, self.files),
                code={side: self.digests[name] for side, name in zip(Side, slot.sides, strict=True)},
                way=self.cup.way,
                brain_folder=self.code_folder,
                recording=self.folder / RECORDINGS / f"{slot.file_name}.mcap",
                logs=self.folder / LOGS / slot.file_name,
                hang_s=self.cup.hang,
                label=slot.name,
            )
        return self._matches[slot]

    def ended(self, slot: Slot, outcome: Outcome) -> Ended:
        """How a match ended, in the order of the teams of its fixture."""
        if isinstance(outcome, Played):
            result, reason = _result(slot, outcome), disturbance(outcome.missed) or None
            return Ended(result, outcome.identity, reason, outcome.recording, chain=outcome.chain)
        return self._forfeited(slot, outcome)

    def _forfeited(self, slot: Slot, failed: Failed) -> Ended:
        if not failed.culprits or failed.kind not in _FORFEITS:
            return Ended(None, failed.identity, failed.reason, evidence=failed.evidence)
        teams = slot.fixture.teams
        culprits = tuple(dict.fromkeys(slot.sides[tuple(Side).index(side)] for side in failed.culprits))
        others = set(teams) - set(culprits)
        first, second = (self.forfeit_goals if team in others else 0 for team in teams)
        result = MatchResult(teams, (first, second), forfeited_by=culprits)
        reason = f"{' and '.join(culprits)} {_FORFEITS[failed.kind]}: {failed.reason}"
        return Ended(result, failed.identity, reason, evidence=failed.evidence)


class _Begun(ConfigModel):
    """What the state of a run has on its cup, besides outcomes."""

    cup: CupConfig
    digests: dict[str, str]
    code_folder: Path
    files: dict[str, Any] | None = None


def stored_plan(store: RunStore) -> CupPlan | None:
    """The plan of the cup of a folder; None before it has begun.

    Raises:
        TouchlineError: it is damaged, or of another version of this program.
    """
    if (text := store.document(_DOCUMENT)) is None:
        return None
    try:
        begun = _Begun.model_validate_json(text)
    except ValidationError as error:
        what = " ".join(str(error).split())[:200]
        raise TouchlineError(f"{store.folder}: its cup is damaged, or of another version: {what}") from None
    return CupPlan(begun.cup, begun.code_folder, store.folder, begun.digests, begun.files)


def store_plan(store: RunStore, plan: CupPlan) -> None:
    """Store the plan of a cup that begins."""
    files = dict(plan.files) if plan.files is not None else None
    begun = _Begun(cup=plan.cup, digests=dict(plan.digests), code_folder=plan.code_folder, files=files)
    store.set_document(_DOCUMENT, begun.model_dump_json())


def digests_of(cup: CupConfig, code_folder: Path) -> dict[str, str]:
    """Team → digest of its files.

    Raises:
        TouchlineError: a team is none that ships.
    """
    return {team.name: code_digest(config_with(team, cup), Side.CYAN, code_folder) for team in cup.teams}


def check_submitted(cup: CupConfig, digests: Mapping[str, str]) -> None:
    """Check that each team has the files that were submitted, where the cup file gives their digest.

    Raises:
        TouchlineError: a team has other files.
    """
    for team in cup.teams:
        found = digests[team.name]
        if team.digest and found != team.digest:
            raise TouchlineError(
                f'the files of team "{team.name}" have the digest {found}, and {team.digest} was submitted; '
                "restore them, or correct teams.digest"
            )


def match_config(cup: CupConfig, slot: Slot, files: Mapping[str, Any] | None = None) -> MatchConfig:
    """The config of a match; it has the cup's name, so that its place is no part of it. `files` are those of the plan.

    Raises:
        TouchlineError: a team is none that ships, or a key of the match is invalid.
    """
    entries = {team.name: team for team in cup.teams}
    config = cup.match_config(files, name=cup.name, seed=slot.seed(cup))
    cyan, magenta = (_team(entries[name], cup) for name in slot.sides)
    changes: dict[str, object] = {"teams": TeamConfigs(cyan=cyan, magenta=magenta)}
    if slot.fixture.decisive:
        changes["referee"] = config.referee.model_copy(update={"winner": True})
    if slot.is_admission:
        changes["duration"] = min(config.duration or ADMISSION_S, ADMISSION_S)
    return MatchConfig.model_validate(config.model_copy(update=changes).model_dump())


def config_with(entry: TeamEntry, cup: CupConfig) -> MatchConfig:
    """A match in which the team plays in cyan.

    Raises:
        TouchlineError: the team is none that ships.
    """
    return MatchConfig(teams=TeamConfigs(cyan=_team(entry, cup)))


def _team(entry: TeamEntry, cup: CupConfig) -> TeamConfig:
    brain = brain_of(entry.brain) if entry.brain is not None else None
    size = entry.size or cup.size
    return TeamConfig(
        name=entry.name, brain=brain, command=entry.command, stdio=entry.stdio, process=entry.process, size=size
    )


def _result(slot: Slot, played: Played) -> MatchResult:
    """The result in the order of the fixture; figures are by side."""
    order = [tuple(Side)[slot.sides.index(team)] for team in slot.fixture.teams]
    first, second = (played.of_soccer.sides[side] for side in order)
    penalties: Pair | None = None
    if first.shoot_out is not None and second.shoot_out is not None:
        penalties = first.shoot_out, second.shoot_out
    yellows, reds = ((first.cards.get(card, 0), second.cards.get(card, 0)) for card in (Card.YELLOW, Card.RED))
    return MatchResult(slot.fixture.teams, (first.goals or 0, second.goals or 0), penalties, yellows, reds)
