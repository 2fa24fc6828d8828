"""Real logs deviate from their schema: readable data is read, the rest is counted and reported."""

import json
import math
import random
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest

from recordings.reading.recording import Recording, open_recording
from recordings.soccer.league.import_log import ImportSummary, import_log
from recordings.soccer.league.team_log import read_team
from schemas.errors import TouchlineError
from schemas.messages.soccer.game import GameState
from schemas.messages.soccer.league.findings import Findings
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import Card, Phase, Score
from schemas.topics import EVENT, STATE, WORLD
from support.msl_log import START_MS, Log, record, robot


@pytest.fixture
def log(tmp_path: Path) -> Log:
    return Log(tmp_path)


def worlds(recording: Recording) -> list[World]:
    return [world for _, world in recording.decoded(WORLD.key)]


def states(recording: Recording) -> list[GameState]:
    return [state for _, state in recording.decoded(STATE.key)]


def found(imported: ImportSummary) -> dict[str, int]:
    return {finding.what: finding.count for finding in [*imported.coped, *imported.lost]}


def test_a_pose_of_either_team_is_turned_into_the_field_frame(log: Log) -> None:
    """A robot 2 m before its own goal side, 1 m to the right: cyan attacks +x, magenta −x."""
    log.write("A", [record(0, [robot(2, [1.0, -2.0, 0.5])])])
    log.write("B", [record(0, [robot(3, [1.0, -2.0, 0.5])])])
    (world,) = worlds(log.read()[1])
    cyan, magenta = world.robots["cyan2"], world.robots["magenta3"]
    assert (cyan.x, cyan.y, cyan.heading, cyan.vx, cyan.vy) == pytest.approx((-2.0, -1.0, 0.5, 0.0, -0.5))
    assert (magenta.x, magenta.y, magenta.vy) == pytest.approx((2.0, 1.0, 0.5))
    assert magenta.heading == pytest.approx(0.5 - math.pi)


DEVIATIONS: dict[str, tuple[dict[str, Any], str]] = {
    "keys of the team's own spelling": ({"robots": [robot() | {"ball_engaged": 1}]}, ""),
    "a number with a point": ({"robots": [robot(2.0)]}, "id of a robot written as 1.0"),
    "a number as a text": ({"robots": [robot("2")]}, "id of a robot written as a text"),
    "two numbers for a pose": ({"robots": [robot(2, [1.0, -2.0])]}, "pose has 2 numbers, not 3"),
    "no heading": ({"robots": [robot(2, [1.0, -2.0, None])]}, "pose has null for a coordinate"),
    "a pose as an object": ({"robots": [robot(2, {"x": 1.0, "y": -2.0, "theta": 0.5})]}, "pose is an object"),
    "true for 1": ({"robots": [robot(ballEngaged=True)]}, "ballEngaged is true or false"),
    "no velocity": ({"robots": [robot(velocity=None)]}, "robot without a velocity"),
    "a confidence of 1.7": ({"balls": [{"position": [0, 3, 0.2], "confidence": 1.7}]}, "confidence outside 0 to 1"),
    "two numbers for a ball": ({"balls": [{"position": [0.0, 3.0]}]}, "position of a ball has 2 numbers, not 3"),
    "a ball beyond any height": ({"balls": [{"position": [0.0, 3.0, 1e308]}]}, "position of a ball is not finite, or"),
    "one ball, no list": ({"balls": {"position": [0.0, 3.0, 0.2], "confidence": 1}}, "ball without a velocity"),
}


@pytest.mark.parametrize("name", DEVIATIONS)
def test_what_deviates_is_read_all_the_same_and_counted(name: str, log: Log) -> None:
    fields, says = DEVIATIONS[name]
    log.write("A", [record(after, **fields) for after in (0, 40, 80)])
    imported, recording = log.read()
    last = worlds(recording)[-1]
    assert (last.robots["cyan2"].x, last.robots["cyan2"].y) == pytest.approx((-2.0, -1.0))
    assert (last.ball.x, last.ball.y) == pytest.approx((3.0, 0.0)) and last.ball.z < 1.0
    assert imported.lost == []
    assert imported.teams[next(iter(imported.teams))].read == 3
    assert [what for what in found(imported) if what.startswith(says)] or not says


def test_keys_may_be_spelled_in_any_way(log: Log) -> None:
    respelled = {"ID": 2, "Pose": [1.0, -2.0, 0.5], "target pose": [0, 0, 0], "Velocity": [0, 0, 0], "ball_engaged": 1}
    log.write("A", [record(0, [respelled])])
    imported, recording = log.read()
    (world,) = worlds(recording)
    assert world.possession == "cyan2"
    assert 'key "target pose" where the schema has "targetPose"' in found(imported)


LOST: dict[str, tuple[Any, str]] = {
    "null coordinates": (record(40, [robot(2, [None, None, None])]), "robot without a position"),
    "no number": (record(40, [robot(None)]), "robot without a number"),
    "a robot in another town": (record(40, [robot(2, [900.0, 0.0, 0.0])]), "robot more than 40 m"),
    "not finite": (record(40, [robot(2, [math.nan, 0.0, 0.0])]), "robot without a position"),
    "twice the same robot": (record(40, [robot(2), robot(2)]), "robot twice in one record"),
    "a ball nowhere": (record(40, balls=[{"position": [None, None, None]}]), "ball without a position"),
    "no time": (record(40) | {"timestamp": None}, "record without a time"),
    "another day": (record(40) | {"timestamp": 5}, "record hours away"),
    "no world": (record(40) | {"worldstate": None}, "record without a worldstate"),
    "no record": (7, "record without a time"),
}


@pytest.mark.parametrize("name", LOST)
def test_what_cannot_be_read_is_counted_and_the_rest_is_read(name: str, log: Log) -> None:
    raw, says = LOST[name]
    log.write("A", [record(0), raw, record(80), record(120)])
    imported, recording = log.read()
    assert [(finding.what.startswith(says), finding.count, finding.first) for finding in imported.lost] == [
        (True, 1, "A, record 2")
    ]
    assert len(worlds(recording)) == 4
    assert worlds(recording)[-1].robots["cyan2"].x == pytest.approx(-2.0)


def test_records_out_of_order_in_bursts_and_of_one_moment_are_sorted(log: Log) -> None:
    """A robot that goes 1 m/s forward: its way is even, whatever order its records came in."""
    times = [0, 40, 120, 80, 160, 163, 163, 200]
    log.write("A", [record(time, [robot(2, [0.0, time / 1e3, 0.0])]) for time in times])
    imported, recording = log.read()
    assert found(imported) == {
        "record out of order: sorted by time": 1,
        "records in a burst, less than 10 ms apart": 1,
        "several records of one time: the last is used": 1,
        "no signals of the referee: the ball counts as in play throughout": 1,
    }
    xs = [world.robots["cyan2"].x for world in worlds(recording)]
    assert xs == pytest.approx([0.0, 0.04, 0.08, 0.12, 0.16, 0.2], abs=1e-6)


def test_a_team_that_is_silent_for_seconds_is_left_out_meanwhile(log: Log) -> None:
    log.write("A", [record(time) for time in range(0, 1001, 100)] + [record(time) for time in range(5000, 6001, 100)])
    log.write("B", [record(time, [robot(1)]) for time in range(0, 6001, 100)])
    imported, recording = log.read()
    assert found(imported)["gap of more than 1 s: the team's bodies are unknown meanwhile"] == 1
    there = {round(world.time, 2): "cyan2" in world.robots for world in worlds(recording)}
    assert there[1.0] and there[1.2] and not there[1.24] and not there[4.96] and there[5.0]
    assert all("magenta1" in world.robots for world in worlds(recording))


def test_a_missing_velocity_is_computed_from_the_distance_between_records(log: Log) -> None:
    """1 m/s toward the opponents' goal."""
    log.write("A", [record(time, [robot(2, [0.0, time / 1e3, 0.0], velocity=[])]) for time in range(0, 401, 40)])
    moving = [world.robots["cyan2"] for world in worlds(log.read()[1])]
    assert [one.vx for one in moving] == pytest.approx([1.0] * len(moving))


def test_headings_go_the_shorter_way_between_records(log: Log) -> None:
    """From 3.1 to −3.1 rad, 80 ms apart: halfway it is π, not 0."""
    log.write("A", [record(time, [robot(2, [0.0, 0.0, at])]) for time, at in ((0, 3.1), (80, -3.1))])
    assert abs(worlds(log.read()[1])[1].robots["cyan2"].heading) == pytest.approx(math.pi, abs=1e-6)


def test_the_surer_team_is_believed_about_the_ball_and_agreeing_teams_are_averaged(log: Log) -> None:
    def ball(x: float, y: float, sure: float) -> list[dict[str, Any]]:
        return [{"position": [x, y, 0.11], "velocity": [0, 0, 0], "confidence": sure}]

    # magenta's axes are turned by π: its (0, −3) is cyan's (0, 3)
    log.write("A", [record(0, balls=ball(0, 3, 0.9)), record(40, balls=ball(0, 3, 0.3)), record(80, balls=[])])
    log.write("B", [record(0, balls=ball(0, -3.4, 0.3)), record(40, balls=ball(0, 6, 0.8)), record(80, balls=[])])
    xs = [world.ball.x for world in worlds(log.read()[1])]
    assert xs[0] == pytest.approx((0.9 * 3 + 0.3 * 3.4) / 1.2)
    assert xs[1] == pytest.approx(-6.0)
    assert xs[2] == pytest.approx(-6.0)


def test_damage_inside_a_file_costs_the_records_it_touches(log: Log) -> None:
    whole = json.dumps([record(time) for time in range(0, 400, 40)])
    middle = whole.index('"robots"', len(whole) // 2)
    log.write("A", whole[:middle] + "\x00#garbage" + whole[middle + 40 :])
    imported, recording = log.read()
    (team, _) = imported.teams.values()
    assert (team.records, team.read) == (9, 9)
    assert [(finding.what, finding.count) for finding in imported.lost] == [
        ("damaged, not JSON up to the next record", 1)
    ]
    assert len(worlds(recording)) == 10


def test_a_file_that_ends_in_the_middle_of_a_record_is_read_up_to_there(log: Log) -> None:
    whole = json.dumps([record(time) for time in range(0, 400, 40)])
    log.write("A", whole[: len(whole) - 300])
    imported, recording = log.read()
    assert next(iter(imported.teams.values())).read == 9
    assert len(imported.lost) == 1 and len(worlds(recording)) == 9


def test_no_cut_and_no_flipped_bit_is_ever_worse_than_counted() -> None:
    """200 cuts and 200 bit flips: never an error, never more records than there were."""
    whole = json.dumps([record(time) for time in range(0, 400, 40)]).encode()
    chance = random.Random(7)
    for _ in range(200):
        cut = whole[: chance.randrange(len(whole))]
        flipped = bytearray(whole)
        flipped[chance.randrange(len(whole))] ^= 1 << chance.randrange(8)
        for damaged in (cut, bytes(flipped)):
            findings = Findings()
            log = read_team(damaged.decode("utf-8", errors="replace"), "A", findings, Findings())
            assert log.read <= log.records <= 10
            assert log.read >= 9 or findings.lost or len(damaged) < len(whole)


CHARACTERS = (
    f"{START_MS - 9000},00:00(00:00),Pre-Game,K,CYAN Kickoff",
    f"{START_MS},00:00(00:00),1st Half,s,START",
    "Connection from 10.0.0.1 accepted",
    f"{START_MS + 1000},00:01(00:01),1st Half - STOP,S,STOP",
    f"{START_MS + 1000},00:01(00:01),1st Half - STOP,a,MAGENTA Goal+",
    f"{START_MS + 1200},00:01(00:01),1st Half - STOP,?,what",
    f"{START_MS + 1500},00:01(00:01),Halftime,h,Halftime",
    f"{START_MS + 1800},00:00(00:00),2nd Half - STOP,k,MAGENTA Kickoff",
    f"{START_MS + 2000},00:00(00:00),2nd Half,s,START",
    f"{START_MS + 3000},00:01(00:01),End Game,e,End Game",
)


def as_json(line: str, cyan: str, magenta: str) -> str:
    """The line as the referee box writes it since 2020."""
    names = {"K": "KICKOFF", "S": "STOP", "s": "START", "A": "GOAL", "H": "HALF_TIME", "E": "END_GAME"}
    if "," not in line:
        return line
    *front, character, _ = line.split(",")
    sided = character.upper() in "KA"
    name = names.get(character, names.get(character.upper(), "?"))
    target = "" if not sided else cyan if character.isupper() else magenta
    said = json.dumps({"command": name, "targetTeam": target})
    return ",".join([*front, said, "null"])


BOTH_KINDS: dict[str, tuple[Callable[[str], str], dict[str, Any]]] = {
    "characters, until 2019": (lambda line: line, {}),
    "JSON with the teams' names": (lambda line: as_json(line, "Reds", "Blues"), {}),
    "JSON with addresses": (lambda line: as_json(line, "224.16.32.9", "224.16.32.8"), {"team_a": "224.16.32.9"}),
}


@pytest.mark.parametrize("kind", BOTH_KINDS)
def test_signals_of_either_kind_tell_the_same_game(kind: str, log: Log) -> None:
    spell, options = BOTH_KINDS[kind]
    log.write("A", [record(time) for time in range(0, 3001, 40)])
    theirs = [record(time, [robot(1)]) for time in range(0, 3001, 40)]
    log.write("B", [one | {"teamName": "Blues"} for one in theirs])
    log.events(*(spell(line) for line in CHARACTERS))
    imported, recording = log.read(**options)
    told = states(recording)
    assert told[-1].phase is Phase.FULL_TIME
    assert (told[-1].score, told[-1].half, told[-1].cyan_attacks) == (Score(magenta=1), 2, -1)
    assert told[-1].clock == pytest.approx(2.5) and told[-1].effective == pytest.approx(2.0)
    assert found(imported) == {
        "signal before the first record: moved to the beginning": 1,
        "line of the box on connections": 1,
        "unknown signal": 1,
    }
    by_time = {round(world.time, 2): world for world in worlds(recording)}
    assert by_time[1.76].robots["cyan2"].x == pytest.approx(-2.0)
    assert by_time[1.84].robots["cyan2"].x == pytest.approx(2.0), "the second half begins with its kick-off"


def test_a_goal_for_an_unknown_address_is_reported_and_counts_for_no_side(log: Log) -> None:
    log.write("A", [record(time) for time in range(0, 3001, 40)])
    log.events(*(as_json(line, "224.16.32.9", "224.16.32.8") for line in CHARACTERS))
    imported, recording = log.read()
    (finding,) = [finding for finding in imported.lost if "--team-a" in finding.what]
    assert finding.count == 3
    assert states(recording)[-1].score == Score()


def test_a_kick_is_inferred_where_the_ball_leaves_a_robot_fast(log: Log) -> None:
    """At 0.4 s the robot has the ball no more; it goes 4 m/s one time, and stays the other."""

    def records(speed: float) -> list[dict[str, Any]]:
        made = []
        for time in range(0, 2001, 40):
            at = max(0.0, time / 1e3 - 0.4) * speed
            balls = [{"position": [0, 0.4 + at, 0.11], "velocity": [0, 0, 0], "confidence": 1}]
            made.append(record(time, [robot(2, [0, 0, 0], ballEngaged=int(time < 400))], balls))
        return made

    log.write("A", records(4.0))
    imported, recording = log.read()
    assert [(round(world.time, 2), world.kicked) for world in worlds(recording) if world.kicked] == [(0.4, "cyan2")]
    assert imported.kicks == 1
    imported.out.unlink()
    log.write("A", records(0.5))
    assert log.read()[0].kicks == 0


def test_a_zip_a_folder_and_single_files_are_the_same_log(log: Log, tmp_path: Path) -> None:
    log.write("A", [record(0), record(40)])
    packed = tmp_path / "packed.zip"
    with ZipFile(packed, "w") as archive:
        for file in log.folder.iterdir():
            archive.write(file, f"logs/{file.name}")
    chains = []
    for number, paths in enumerate([[packed], [log.folder], list(log.folder.iterdir())]):
        imported = import_log(paths, tmp_path / f"{number}.mcap")
        chains.append([one.payload for one in open_recording(imported.out).messages(WORLD.key)])
    assert chains[0] == chains[1] == chains[2] and len(chains[0]) == 2


def test_files_that_are_no_log_get_one_plain_sentence(tmp_path: Path) -> None:
    def said(content: bytes, name: str) -> str:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(TouchlineError) as error:
            import_log([tmp_path / name], tmp_path / "out.mcap")
        assert "\n" not in str(error.value)
        assert not (tmp_path / "out.mcap").exists()
        return str(error.value)

    assert "not a log of the league" in said(b"hello", "notes.txt")
    assert "has no world state" in said(b"", "empty.A.msl")
    assert "has no world state" in said(b"\x00\xff\xfe" * 50, "noise.A.msl")
    assert "has no world state" in said(b'[{"timestamp": 1}]', "poor.A.msl")
    microseconds = json.dumps([record(40) | {"timestamp": 1.6e18 + count} for count in range(3)]).encode()
    assert "3 times record without a time" in said(microseconds, "microseconds.A.msl")
    packed = tmp_path / "good.zip"
    with ZipFile(packed, "w") as archive:
        archive.writestr("x.A.msl", json.dumps([record(time) for time in range(0, 4000, 40)]))
    content = bytearray(packed.read_bytes())
    assert "truncated zip, its table of contents is missing" in said(bytes(content[:-100]), "cut.zip")
    content[80] ^= 0xFF
    assert "damaged zip" in said(bytes(content), "flipped.zip")
    with pytest.raises(TouchlineError, match="No such file"):
        import_log([tmp_path / "nothing.zip"], tmp_path / "out.mcap")


BOX_OF_2024 = """New BaseStation @ 127.0.0.1
Connection from 127.0.0.1 accepted - Left
-900,00:03(00:00),Pre-Game,Welcome,localhost
0,00:05(00:00),Pre-Game,Kickoff,localhost
200,00:00(00:00),Pre-Game,1st half,
201,00:00(00:00),Pre-Game,START,
1000,00:01(00:01),1st Half,STOP,
1100,00:01(00:01),1st Half - STOP,Goal+,localhost
1200,00:01(00:01),1st Half - STOP,Red Card,localhost B
1300,00:01(00:01),1st Half - STOP,Yellow Card,localhost
1400,00:01(00:01),1st Half - STOP,Kickoff,localhost B
1500,00:01(00:01),1st Half - STOP,START,
2000,00:02(00:02),1st Half,STOP,
2100,00:00(00:00),Halftime,Halftime,
2200,00:00(00:00),Halftime,Park,
2500,00:00(00:00),Halftime,Kickoff,localhost B
2600,00:00(00:00),Halftime,2nd half,
2601,00:00(00:00),Halftime,START,
3000,00:00(00:00),2nd Half,Repair,localhost B
3500,00:01(00:01),2nd Half,Substitution,robotID:3,localhost
3600,00:01(00:01),2nd Half,STOP,
3700,00:01(00:01),End Game,Game Over,
"""


def test_the_log_of_the_box_of_2024_imports_with_score_cards_and_halves(log: Log) -> None:
    both = [record(time) | {"teamName": "localhos"} for time in range(0, 4001, 40)]
    log.write("A", both)
    log.write("B", both)
    log.events(
        *(re.sub(r"^-?\d+", lambda found: str(START_MS + int(found[0])), line) for line in BOX_OF_2024.split("\n"))
    )
    imported, recording = log.read()
    assert (imported.signals, imported.lost) == (20, [])
    after = {round(state.time, 1): state for state in states(recording)}
    assert [(after[time].half, after[time].phase) for time in (0.2, 1.4, 2.1, 2.6, 3.7)] == [
        (1, Phase.PLAY),
        (1, Phase.KICK_OFF),
        (1, Phase.HALF_TIME),
        (2, Phase.PLAY),
        (2, Phase.FULL_TIME),
    ]
    assert after[3.7].score == Score(cyan=1, magenta=0)
    assert (after[1.4].cyan_attacks, after[3.7].cyan_attacks) == (1, -1)
    cards = [(one.card, one.side) for _, one in recording.decoded(EVENT.key) if one.card is not None]
    assert cards == [(Card.RED, Side.MAGENTA), (Card.YELLOW, Side.CYAN)]
