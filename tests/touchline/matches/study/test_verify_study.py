"""Studies that were played are checked: whatever was changed is named."""

import json
import re
import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from schemas.errors import TouchlineError
from support.short_study import ONE_CELL, Run

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pyarrow", reason="experiments need the extra study")
pd = pytest.importorskip("pandas", reason="experiments need the extra study")

from touchline.matches.study import study_folder  # noqa: E402
from touchline.matches.study.verify_study import StudyVerdict, verify_study  # noqa: E402

STILL = """
from touchline import Command


class Still:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        return Command(answers_tick=sight.tick)
"""


def verdict_of(home: Path, sample: int | None = None, *, from_recordings: bool = True) -> StudyVerdict:
    return verify_study(home, ThreadPoolExecutor(1), sample, None, from_recordings=from_recordings)


def check(home: Path, sample: int | None = None) -> list[str]:
    return verdict_of(home, sample).faults


def test_a_study_is_reproduced_to_the_byte(played: Path, home: Path) -> None:
    verdict = verdict_of(home)
    assert (verdict.faults, verdict.played_again, verdict.byte_identical) == ([], 4, True)
    assert verdict.notes == []


def test_a_study_folder_can_be_moved_and_verified_without_its_study_file(
    played: Path, home: Path, tmp_path: Path
) -> None:
    (tmp_path / "try.toml").unlink()
    moved = shutil.move(home, tmp_path / "published")
    (Path(moved) / "run.sqlite").unlink()
    assert check(Path(moved), sample=1) == []


@pytest.mark.parametrize("record", ["false", "true", '"inputs"'])
def test_a_study_of_a_game_without_goals_is_verified(run: Run, home: Path, record: str) -> None:
    match = Path(__file__).parents[4] / "touchline" / "tasks" / "coverage.toml"
    run(
        f'match = "{match}"\nboth_sides = false\nseeds = "1"\nresponses = ["score"]\nrecord = {record}\n'
        "[settings]\nduration = 0.5\n"
    )
    assert check(home) == []


def test_verification_names_the_match_whose_result_was_changed(played: Path, home: Path) -> None:
    table = pd.read_csv(home / "results.csv")
    table.loc[2, "distance"] += 1.0
    table.to_csv(home / "results.csv", index=False, lineterminator="\n")
    faults = check(home)
    assert any("results.csv was changed" in fault for fault in faults)
    assert any("results.parquet and results.csv have different values" in fault for fault in faults)
    assert [fault for fault in faults if fault.startswith("cell")] == [
        fault for fault in faults if fault.startswith("cell 1, seed 2: distance is")
    ]


def test_a_study_is_verified_from_its_recordings_without_its_teams(run: Run, home: Path, tmp_path: Path) -> None:
    (tmp_path / "still_robot.py").write_text(STILL)
    run(f"record = true\n{ONE_CELL}".replace("[settings]", '[settings]\ncyan = "still_robot:Still"'))
    (tmp_path / "still_robot.py").unlink()
    verdict = verdict_of(home)
    assert (verdict.faults, verdict.played_again, verdict.byte_identical) == ([], 2, True)
    first, second = sorted((home / "recordings").glob("*.mcap"))[:2]
    first.write_bytes(second.read_bytes())
    faults = check(home)
    assert any(f"recordings/{first.name} was changed after the study" in fault for fault in faults)
    assert any("its configuration is not that of the plan" in fault for fault in faults)


def test_a_sample_reads_no_recording_of_another_match(run: Run, home: Path) -> None:
    run(f"record = true\n{ONE_CELL}")
    for path in (home / "recordings").glob("*.mcap"):
        path.write_bytes(path.read_bytes()[:-1])
    assert verdict_of(home, 0).faults == []
    assert sum("was changed after the study" in fault for fault in verdict_of(home, 1).faults) == 1


def test_a_study_that_is_older_than_a_figure_is_reproduced_without_it(played: Path, home: Path) -> None:
    table = pd.read_csv(home / "results.csv").drop(columns="fouls")
    (home / "results.csv").write_bytes(study_folder.csv_bytes(table))
    table.to_parquet(home / "results.parquet", index=False)
    digests = json.loads((home / "digests.json").read_text())
    study_folder.write_digests(home, digests["seeds"], digests["code"])
    verdict = verdict_of(home)
    assert (verdict.faults, verdict.byte_identical) == ([], True)
    assert verdict.notes == ["fouls is a figure that the study does not have"]


def test_recordings_of_inputs_alone_are_small_and_are_verified(run: Run, home: Path) -> None:
    run(f'record = "inputs"\n{ONE_CELL}')
    whole = verdict_of(home)
    assert (whole.faults, whole.played_again, whole.byte_identical) == ([], 2, None)
    again = verdict_of(home, from_recordings=False)
    assert (again.faults, again.byte_identical) == ([], True)


def test_a_row_that_was_taken_out_of_the_table_is_missed(played: Path, home: Path) -> None:
    table = pd.read_csv(home / "results.csv")
    table.drop(index=1).to_csv(home / "results.csv", index=False, lineterminator="\n")
    assert "cell 2, seed 1: has no result, and was played to its end again" in check(home)


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("results.csv", None, "No such file or directory; run"),
        ("results.csv", "", "no table (No columns"),
        ("results.csv", "cell,seed\n1,1\n", "swapped is missing; run"),
        ("digests.json", "{}", "seeds is missing; run"),
        ("plan.json", '{"cells": ', "no JSON object (Expecting value"),
    ],
)
def test_a_file_that_is_gone_or_none_is_one_line(
    played: Path, home: Path, name: str, content: str | None, why: str
) -> None:
    (home / name).unlink()
    if content is not None:
        (home / name).write_text(content)
    with pytest.raises(TouchlineError, match=rf"^{re.escape(f'{home / name}: {why}')}"):
        verdict_of(home)


def test_a_damaged_table_and_a_row_of_the_other_side_are_named(played: Path, home: Path) -> None:
    (home / "results.parquet").write_bytes((home / "results.parquet").read_bytes()[:3000])
    text = (home / "results.csv").read_text()
    (home / "results.csv").write_text(text.replace(",False,", ",True,", 1))
    faults = check(home)
    assert "results.parquet is damaged" in faults
    assert "cell 1, seed 1: has no result, and was played to its end again" in faults
