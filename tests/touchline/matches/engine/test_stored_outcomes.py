"""Outcomes of many matches, as a run keeps them."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig
from touchline.matches.engine import outcomes as outcomes_module
from touchline.matches.engine.outcome import Failed, FailureKind, Outcome, Played
from touchline.matches.engine.plan import ListPlan
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play import play
from touchline.matches.engine.store import MemoryStore, RunStore

MatchOf = Callable[..., MatchConfig]


@pytest.fixture
def played(match_of: MatchOf, folder: Path) -> Played:
    outcome = play(PlannedMatch(match_of(), brain_folder=folder))
    assert isinstance(outcome, Played)
    return outcome


def test_a_run_is_resumed_without_decoding_its_outcomes(
    played: Played, match_of: MatchOf, folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = ListPlan(tuple(PlannedMatch(match_of(seed=seed), brain_folder=folder) for seed in range(1, 6)))
    with RunStore(tmp_path) as store:
        for planned in plan.matches[:3]:
            store.add(replace(played, identity=planned.identity))

    def decode(text: bytes) -> Outcome:
        raise AssertionError(f"decoded: {text[:20]!r}")

    monkeypatch.setattr(outcomes_module, "from_json", decode)
    with RunStore(tmp_path) as store:
        outcomes = store.outcomes()
    assert len(outcomes) == 3
    assert list(plan.due(outcomes)) == list(plan.matches[3:])


def test_outcomes_are_looked_up_as_they_were_added(played: Played, tmp_path: Path) -> None:
    failed = Failed("another", FailureKind.HUNG, "no answer")
    with RunStore(tmp_path) as store:
        store.add(played)
        store.add(failed)
        outcomes = store.outcomes()
    assert dict(outcomes) == {played.identity: played, "another": failed}
    outcomes["another"] = replace(failed, reason="lost")
    del outcomes[played.identity]
    assert dict(outcomes) == {"another": replace(failed, reason="lost")}


def test_a_change_of_the_outcomes_that_a_store_returned_is_no_change_of_the_store(
    played: Played, tmp_path: Path
) -> None:
    store = MemoryStore(tmp_path)
    store.add(played)
    del store.outcomes()[played.identity]
    assert dict(store.outcomes()) == {played.identity: played}
