"""Lines of the referee box's file: what each of their parts means, and what is counted where one cannot be read."""

import json

import pytest

from recordings.soccer.league.event_log import SignalLine, TeamNames, read_events
from recordings.soccer.league.game_log import GameLog
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.messages.soccer.league.findings import Findings
from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase

NAMES = TeamNames("Tech United", "Falcons")


def read(rest: str, part: str = "1st Half", clock: str = "01:05(00:20)", names: TeamNames = NAMES) -> SignalLine:
    (line,) = read_events(f" 1467216000123 ,{clock},{part},{rest}", names, Findings())
    return line


def named(command: str, **fields: object) -> str:
    return json.dumps({"command": command, **fields})


def lost(line: str) -> list[str]:
    findings = Findings()
    lines = read_events(line, NAMES, findings)
    assert bool(lines) == any("unknown team" in one.what for one in findings.lost)
    assert all(one.first == "events, line 1" for one in findings.lost)
    return [one.what for one in findings.lost]


def test_a_line_has_time_clock_half_signal_side_and_text() -> None:
    line = read("A,CYAN Goal+", "2nd Half - STOP")
    assert (line.epoch_ms, line.game_s, line.half, line.is_shoot_out) == (1467216000123.0, 65.0, 2, False)
    assert (line.signal.name, line.side, line.text) == ("GOAL", Side.CYAN, "CYAN Goal+")
    assert read("s,START", clock="").game_s is None
    assert read("S,STOP", "Penalties/STOP").is_shoot_out


@pytest.mark.parametrize(
    ("rest", "side", "text"),
    [
        ("K,", Side.CYAN, "Kickoff"),
        ("k", Side.MAGENTA, "Kickoff"),
        ("K, magenta  Kickoff ", Side.MAGENTA, "magenta  Kickoff"),
        ("s,MAGENTA START", None, "MAGENTA START"),
        (" S ,", None, "STOP"),
    ],
)
def test_a_character_names_a_signal_whose_text_takes_precedence_for_its_side(rest: str, side: Side, text: str) -> None:
    line = read(rest)
    assert (line.side, line.text) == (side, text)


@pytest.mark.parametrize(
    ("rest", "side", "text"),
    [
        (named("goal", targetTeam="Falcons"), Side.MAGENTA, "Goal+ magenta"),
        ("  " + named(" GOAL ", targetTeam=" tech united "), Side.CYAN, "Goal+ cyan"),
        (named("YELLOW_CARD", targetTeam="cyan", robotID=3), Side.CYAN, "Yellow Card cyan, robot 3"),
        (named("YELLOW_CARD", targetTeam="b", robotID=0) + ", a hard foul ", Side.MAGENTA, "a hard foul, robot 0"),
        (named("YELLOW_CARD", targetTeam="teamA", robotID=-1) + ",null", Side.CYAN, "Yellow Card cyan"),
        (named("YELLOW_CARD", targetTeam="teamA", robotID="3"), Side.CYAN, "Yellow Card cyan"),
        (named("START", targetTeam="Falcons"), None, "START"),
    ],
)
def test_json_names_a_signal_its_team_and_its_robot(rest: str, side: Side | None, text: str) -> None:
    line = read(rest)
    assert (line.side, line.text) == (side, text)


@pytest.mark.parametrize(
    ("rest", "name", "side", "text"),
    [
        ("START,", "START", None, "START"),
        ("Goal+,Tech United", "GOAL", Side.CYAN, "Goal+ cyan"),
        ("Red Card,FALCONS ", "RED_CARD", Side.MAGENTA, "Red Card magenta"),
        ("Substitution,robotID:3,Falcons", "SUBSTITUTION", Side.MAGENTA, "Substitution magenta, robot 3"),
        ("Penalty,Falcons", "PENALTY", Side.MAGENTA, "Penalty Kick magenta"),
        ("Repair ended,Falcons", "REPAIR_END", Side.MAGENTA, "Repair In magenta"),
        ("1st half,", "FIRST_HALF", None, "1st half"),
    ],
)
def test_a_description_names_a_signal_its_robot_and_its_team(rest: str, name: str, side: Side, text: str) -> None:
    line = read(rest)
    assert (line.signal.name, line.side, line.text) == (name, side, text)


def test_the_headers_of_the_teams_may_have_the_first_eight_letters_of_their_names() -> None:
    names = TeamNames("Tech Uni", "Falcons")
    assert read("Goal+,Tech United", names=names).side is Side.CYAN
    assert read("Goal+,Falcons", names=names).side is Side.MAGENTA
    assert read("Goal+,Carpe Noctem", names=names).side is None


@pytest.mark.parametrize(
    ("marked", "sides"), [("localhost B", [Side.CYAN, Side.MAGENTA]), ("localhost A", [Side.MAGENTA, Side.CYAN])]
)
def test_a_team_against_itself_is_told_apart_by_the_letter_behind_one_name(marked: str, sides: list[Side]) -> None:
    text = f"1000,00:01(00:01),1st Half,Goal+,localhost\n2000,00:02(00:02),1st Half,Red Card,{marked}\n"
    lines = read_events(text, TeamNames("localhos", "localhos"), Findings())
    assert [line.side for line in lines] == sides


def test_an_address_given_as_team_a_decides_all_others_for_team_b() -> None:
    names = NAMES._replace(team_a=" 224.16.32.44 ")
    for target, side in (("224.16.32.44", Side.CYAN), ("224.16.32.45", Side.MAGENTA), ("cyan", Side.MAGENTA)):
        assert read(named("GOAL", targetTeam=target), names=names).side is side


def test_names_that_do_not_tell_the_teams_apart_are_not_used() -> None:
    for names in (TeamNames("One", "one"), TeamNames("", "one")):
        assert read(named("GOAL", targetTeam="one"), names=names).side is None


def test_half_time_after_the_last_part_is_the_end_of_the_game() -> None:
    assert read("h,Halftime", "End Game").signal.name == "END_GAME"
    assert read("h,Halftime", "Halftime").signal.name == "HALF_TIME"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("no signal", "line that is not a signal"),
        ("1000,00:10,1st Half,?,what", "unknown signal"),
        ('1000,00:10,1st Half,{"command": "DANCE"}', "unknown signal"),
        ('1000,00:10,1st Half,{"command": ', "signal that is not JSON"),
        ('1000,00:10,1st Half,{"command": "GOAL"}', "signal for an unknown team"),
    ],
)
def test_what_cannot_be_read_is_counted_as_lost_with_its_line(line: str, words: str) -> None:
    assert any(words in one for one in lost(line))


def test_lines_of_the_box_on_connections_are_no_signals_and_no_loss() -> None:
    findings = Findings()
    text = "New BaseStation @ 127.0.0.1\nConnection from 127.0.0.1 accepted - Left\nTeam Falcons dropped"
    assert read_events(text, NAMES, findings) == []
    assert [(one.what, one.count) for one in findings.coped] == [("line of the box on connections", 3)]
    assert not findings.lost


def test_signals_are_sorted_by_time_and_empty_lines_are_none() -> None:
    findings = Findings()
    lines = read_events("2000,00:02,1st Half,S,\n\x00 \t\n1000,00:01,1st Half,s,", NAMES, findings)
    assert [line.epoch_ms for line in lines] == [1000.0, 2000.0]
    assert [one.what for one in findings.coped] == ["signals out of order: sorted by time"] and not findings.lost


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"phase": Phase.FULL_TIME}, "End Game"),
        ({"phase": Phase.HALF_TIME}, "Halftime"),
        ({"phase": Phase.PARKING}, "Halftime"),
        ({"phase": Phase.HALF_TIME, "stage": GameStage.EXTRA_TIME, "half": 3}, "Overtime - Halftime"),
        ({"phase": Phase.STOPPED, "stage": GameStage.SHOOT_OUT}, "Penalties/STOP"),
        ({"phase": Phase.STOPPED, "stage": GameStage.SHOOT_OUT, "running": True}, "Penalties"),
        ({"phase": Phase.STOPPED}, "1st Half - STOP"),
        ({"phase": Phase.STOPPED, "half": 4, "stage": GameStage.EXTRA_TIME}, "Overtime - 2nd Half - STOP"),
        ({"phase": Phase.PLAY, "running": True, "half": 2}, "2nd Half"),
        ({"phase": Phase.PLAY, "running": True, "half": 5}, "Half 5"),
    ],
)
def test_a_written_line_names_its_part_of_the_game(changes: dict[str, object], part: str) -> None:
    state = GameState.decode(GameState(tick=0, time=0.0, phase=Phase.THROW_IN, side=Side.CYAN).encode())
    log = GameLog(1_000_000, {})
    log.update(state)
    log.lines.clear()
    log.update(state.replace(tick=150, time=3.0, clock=62.5, effective=61.0, **changes))
    assert {tuple(line.split(",")[i] for i in (0, 2)) for line in log.lines} == {("1003000", part)}


def test_a_robot_in_repair_before_the_game_is_a_line_of_its_part() -> None:
    log = GameLog(1_000_000, {"cyan1": Side.CYAN})
    state = GameState(tick=0, time=0.0, phase=Phase.PRE_GAME)
    log.update(state)
    log.update(state.replace(robots={"cyan1": DisciplinaryRecord(off_field=OffField.REPAIR)}))
    assert [line.split(",")[2] for line in log.lines] == ["Pre-Game"]
