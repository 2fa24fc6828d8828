"""Verification of a cup names what does not fit."""

import json
import shutil
import sqlite3
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from schemas.errors import TouchlineError
from schemas.side import Side
from support.brisk import BRISK
from support.cups import CUP, mini_cup, play
from touchline.matches.cup.cup_config import load_cup
from touchline.matches.cup.cup_plan import CupPlan, digests_of
from touchline.matches.cup.verify_cup import CupVerdict, verify_cup
from touchline.matches.engine.outcome import Failed, FailureKind, Played
from touchline.matches.engine.store import RunStore


@pytest.fixture
def cup(undisturbed: Path, tmp_path: Path) -> Iterator[Path]:
    """A copy of the folder of a cup, which has been moved."""
    shutil.copytree(undisturbed / "out", tmp_path / "moved")
    yield tmp_path / "moved"


def verified(folder: Path, sample: int | None = 1) -> CupVerdict:
    with ThreadPoolExecutor(1) as executor:
        return verify_cup(folder, executor, sample)


def identity_of(folder: Path, name: str, undisturbed: Path) -> str:
    config = load_cup(undisturbed / "mini.toml")
    plan = CupPlan(config, undisturbed, folder, digests_of(config, undisturbed))
    (slot,) = (one.slot for one in plan.state({}).matches if one.slot.name == name)
    return plan.match(slot).identity


def test_a_cup_whose_folder_was_moved_is_verified(cup: Path) -> None:
    whole = verified(cup, None)
    assert (whole.faults, whole.notes, whole.simulated) == ([], [], 6)
    part = verified(cup, 1)
    assert (part.faults, part.simulated) == ([], 1)
    assert 0 < part.ticks < whole.ticks


def test_a_cup_that_has_not_begun_is_not_verified(tmp_path: Path) -> None:
    RunStore(tmp_path).close()
    with pytest.raises(TouchlineError, match="its cup has not begun; nothing can be verified"):
        verified(tmp_path)


def test_a_cup_by_a_rule_book_of_its_own_is_verified_where_that_file_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(BRISK, "own.toml")
    Path("mini.toml").write_text(CUP.replace(str(BRISK), "own.toml"))
    with closing(mini_cup(tmp_path)) as run:
        assert play(run, 1).is_complete
    Path("own.toml").write_text(Path("own.toml").read_text().replace("0.2", "0.3"))
    with pytest.raises(TouchlineError, match="its scene, profile or rule book has changed since; restore it"):
        mini_cup(tmp_path, resume=True)
    Path("own.toml").unlink()
    verdict = verified(tmp_path / "out")
    assert (verdict.faults, verdict.simulated) == ([], 1)


def test_a_stored_result_that_was_changed_is_named_with_its_match_and_the_table(cup: Path, undisturbed: Path) -> None:
    with closing(RunStore(cup)) as store:
        outcome = store.outcomes()[identity_of(cup, "league 3", undisturbed)]
        assert isinstance(outcome, Played)
        sides = {side: replace(figures, goals=7) for side, figures in outcome.figures.sides.items()}
        store.add(replace(outcome, figures=replace(outcome.figures, sides=sides)))
    faults = verified(cup, None).faults
    assert faults[0].startswith("league 3: ") and faults[0].endswith(" is recorded, and 7 : 7 in the table")
    assert any(fault.startswith("result.json: ") for fault in faults)


def test_a_recording_of_another_match_or_none_is_named(cup: Path) -> None:
    recordings = cup / "recordings"
    shutil.copy(recordings / "league_1.mcap", recordings / "league_2.mcap")
    (recordings / "league_3.mcap").unlink()
    faults = verified(cup, None).faults
    assert any(
        fault == "league 2: it is the recording of another match: its configuration is not that of the plan"
        for fault in faults
    )
    assert any(fault.startswith("league 3: ") for fault in faults)


def test_a_sample_reads_no_recording_of_another_match_and_names_one_that_is_gone(cup: Path) -> None:
    first, *others = sorted((cup / "recordings").glob("league_*.mcap"))
    first.unlink()
    for path in others:
        path.write_bytes(b"")
    assert verified(cup, 0).faults == ["league 1: its recording is gone"]
    assert len(verified(cup, 1).faults) in (1, 2)


def test_a_published_table_that_does_not_follow_from_the_matches_is_named(cup: Path) -> None:
    page, result = cup / "index.html", cup / "result.json"
    content = json.loads(result.read_text())
    first, second, *_ = content["tables"]["league"]
    content["tables"]["league"][0] = second | {"place": 1}
    content["matches"][-1]["chain"] = "another"
    result.write_text(json.dumps(content))
    page.write_text(page.read_text().replace("<b>", "<b>9"))
    assert verified(cup).faults == [
        f"result.json: place 1 of league is {second['team']}, and {first['team']} by the matches",
        f"result.json: match {content['matches'][-1]['match']} is not the stored one",
        "index.html: its table of league is not the one that follows from the matches",
    ]
    result.write_text(json.dumps(content | {"tables": {"league": [None]}}))
    assert verified(cup).faults[0] == "result.json: tables is not the one that follows from the matches"
    result.write_text("1")
    assert verified(cup).faults[0].startswith("result.json: 'int' object is not iterable; play the cup with --resume")


@pytest.mark.parametrize(("table", "why"), [("outcomes", "damaged"), ("documents", "its cup is damaged")])
def test_a_damaged_state_is_one_line(cup: Path, table: str, why: str) -> None:
    with closing(sqlite3.connect(cup / "run.sqlite", isolation_level=None)) as database:
        database.execute(f"UPDATE {table} SET content = '{{'")
    with pytest.raises(TouchlineError, match=why):
        verified(cup)


def test_files_of_a_team_that_have_changed_are_a_fault_and_absent_ones_a_note(tmp_path: Path) -> None:
    own = tmp_path / "own_team.py"
    own.write_text("class Own: ...")
    (tmp_path / "mini.toml").write_text(CUP.replace('"random"', '"own_team:Own"'))
    mini_cup(tmp_path).close()
    own.write_text("class Own: pass")
    assert 'the files of team "Three" have changed since the cup began' in verified(tmp_path / "out").faults
    own.unlink()
    verdict = verified(tmp_path / "out")
    assert any('the files of team "Three" are not here' in note for note in verdict.notes)


def test_a_failed_match_whose_evidence_is_gone_is_named(tmp_path: Path) -> None:
    with closing(mini_cup(tmp_path)) as run:
        (first, *_) = run.plan.due({})
    with closing(RunStore(tmp_path / "out")) as store:
        store.add(
            Failed(first.identity, FailureKind.CRASHED, "no ball", (Side.CYAN,), "logs/admission_1/traceback.txt")
        )
    assert "admission 1: its evidence logs/admission_1/traceback.txt is gone" in verified(tmp_path / "out").faults
