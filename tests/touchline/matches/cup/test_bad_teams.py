"""A cup of four teams that crash, hang, never start and cheat ends with the right table, and keeps the evidence."""

from contextlib import closing
from pathlib import Path

import pytest

from support.bad_teams import SOURCE
from support.cups import play
from touchline.matches.cup.cup_config import CupConfig, FormatConfig, FormatKind, TeamEntry
from touchline.matches.cup.cup_state import CupState
from touchline.matches.cup.run_cup import CupRun


def played(tmp_path: Path, teams: list[str], *, duration: float, **keys: object) -> CupState:
    (tmp_path / "bad_teams.py").write_text(SOURCE)
    entries = [TeamEntry(name=name, brain=f"bad_teams:{name}") for name in teams]
    cup = CupConfig(teams=entries, size=1, match={"duration": duration}, **keys)  # type: ignore[arg-type]
    with closing(CupRun(cup, tmp_path, tmp_path / "cup", resume=False)) as run:
        return play(run, 2)


def forfeits(state: CupState) -> dict[str, str]:
    """Teams of a match → the team that forfeited it."""
    return {
        " ".join(sorted(one.slot.fixture.teams)): one.result.forfeited_by
        for one in state.matches
        if one.result is not None and one.result.forfeited_by is not None
    }


def reasons(state: CupState) -> str:
    return "\n".join(f"{one.slot.name} {one.state}: {one.ended.reason}" for one in state.matches if one.ended)


def test_in_one_process_a_match_each_who_fails_first_forfeits(tmp_path: Path) -> None:
    state = played(tmp_path, ["Sound", "Crashes", "Hangs", "NeverStarts"], duration=4.0, hang=2.0)
    assert state.is_complete, reasons(state)
    assert forfeits(state) == {
        "Crashes Sound": "Crashes",
        "Hangs Sound": "Hangs",
        "NeverStarts Sound": "NeverStarts",
        "Crashes Hangs": "Crashes",
        "Crashes NeverStarts": "NeverStarts",
        "Hangs NeverStarts": "NeverStarts",
    }, reasons(state)
    rows = {
        row.team: (row.place, row.points, row.goals_for, row.goals_against) for row in state.schedule.tables["league"]
    }
    assert rows == {
        "Sound": (1, 9, 9, 0),
        "Hangs": (2, 6, 6, 3),
        "Crashes": (3, 3, 3, 6),
        "NeverStarts": (4, 0, 0, 9),
    }
    logs = "\n".join(file.read_text() for file in sorted((tmp_path / "cup" / "logs").rglob("*.*")))
    for part in ("ValueError: no ball", "RuntimeError: no camera", "in act"):
        assert part in logs
    page = (tmp_path / "cup" / "index.html").read_text()
    assert "Crashes crashed: " in page and "Hangs hung: " in page and "NeverStarts did not start: " in page


@pytest.mark.processes
def test_with_processes_teams_that_crash_hang_never_start_and_cheat_forfeit(tmp_path: Path) -> None:
    cup_format = FormatConfig(kind=FormatKind.KNOCK_OUT, third_place=False)
    teams = ["Hangs", "Floods", "Crashes", "NeverStarts"]
    state = played(tmp_path, teams, duration=8.0, way="processes", format=cup_format)
    assert forfeits(state) == {
        "Hangs NeverStarts": "NeverStarts",
        "Crashes Floods": "Crashes",
        "Floods Hangs": "Floods",
    }, reasons(state)
    assert state.winner == "Hangs"
    assert not list((tmp_path / "cup").rglob("credentials"))
    assert "Floods broke the access rules: account" in reasons(state)
    logs = "\n".join(file.read_text() for file in sorted((tmp_path / "cup" / "logs").rglob("*.*")))
    for part in ("ValueError: no ball", "RuntimeError: no camera", "is over its limit of messages"):
        assert part in logs
