"""A cup of teams that crash, hang, never start and cheat is won by the sound one, and keeps the evidence."""

from contextlib import closing
from pathlib import Path

import pytest

from support.bad_teams import SOURCE
from support.brisk import BRISK
from support.cups import play
from touchline.matches.cup.cup_config import CupConfig, FormatConfig, FormatKind, TeamEntry
from touchline.matches.cup.cup_state import CupState
from touchline.matches.cup.report import report_of
from touchline.matches.cup.run_cup import CupRun


def played(tmp_path: Path, teams: dict[str, str], *, duration: float, **keys: object) -> CupState:
    """A cup of these teams: name → brain."""
    (tmp_path / "bad_teams.py").write_text(SOURCE)
    entries = [TeamEntry(name=name, brain=brain) for name, brain in teams.items()]
    match = {"duration": duration, "rules": str(BRISK), "scene": "one_against_keeper", "patience": {"answer": 3.0}}
    cup = CupConfig(teams=entries, size=1, match=match, **keys)  # type: ignore[arg-type]
    with closing(CupRun(cup, tmp_path, tmp_path / "cup", resume=False)) as run:
        return play(run, 2)


def bad(*names: str) -> dict[str, str]:
    return {name: f"bad_teams:{name}" for name in names}


def reasons(state: CupState) -> str:
    return "\n".join(f"{one.slot.name} {one.state}: {one.ended.reason}" for one in state.matches if one.ended)


def evidence(tmp_path: Path) -> str:
    return "\n".join(file.read_text() for file in sorted((tmp_path / "cup" / "logs").rglob("*.*")))


def test_a_cup_of_a_sound_team_and_ones_that_crash_hang_cheat_and_never_start_is_won_by_the_sound_one(
    tmp_path: Path,
) -> None:
    teams = {**bad("Crashes", "Hangs", "Cheats", "NeverStarts"), "Good": "simple"}
    state = played(tmp_path, teams, duration=6.0, hang=2.0, format=FormatConfig(double=True))
    assert state.is_complete, reasons(state)
    assert state.refused == {"Crashes", "Hangs", "NeverStarts"}, reasons(state)
    assert state.winner == "Good"
    assert report_of(state)["refused"] == ["Crashes", "Hangs", "NeverStarts"]
    rows = {row.team: (row.place, row.played, row.points) for row in state.schedule.tables["league"]}
    assert rows["Good"][:2] == (1, 2) and rows["Good"][2] >= 4
    assert rows["Cheats"][:2] == (2, 2)
    assert all((played, points) == (0, 0) for team, (_, played, points) in rows.items() if team in state.refused)
    logs = evidence(tmp_path)
    for part in ("ValueError: no ball", "RuntimeError: no camera", "in act"):
        assert part in logs
    page = (tmp_path / "cup" / "index.html").read_text()
    for part in ("Crashes crashed: ", "Hangs hung: ", "NeverStarts did not start: ", "not admitted"):
        assert part in page


@pytest.mark.processes
def test_with_processes_a_team_that_fails_alone_is_refused_and_nobody_wins_a_cup_of_such_teams(tmp_path: Path) -> None:
    cup_format = FormatConfig(kind=FormatKind.KNOCK_OUT, third_place=False)
    teams = bad("Hangs", "Floods", "Crashes", "NeverStarts")
    state = played(tmp_path, teams, duration=8.0, way="processes", format=cup_format)
    assert state.refused == set(teams), reasons(state)
    assert state.is_complete and state.winner is None
    assert not list((tmp_path / "cup").rglob("credentials"))
    assert "Floods broke the access rules: account" in reasons(state)
    logs = evidence(tmp_path)
    for part in ("ValueError: no ball", "RuntimeError: no camera", "is over its limit of messages"):
        assert part in logs
