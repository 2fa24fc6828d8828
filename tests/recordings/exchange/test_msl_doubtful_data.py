"""An import does not believe what a log's positions contradict, and names what a recording has no place for."""

import math
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from recordings.reading.recording import Recording, open_recording
from recordings.soccer.league.event_log import TeamNames, read_events
from recordings.soccer.league.import_log import ImportSummary
from recordings.soccer.stats.match_statistics import figures_of_recording
from recordings.soccer.stats.table import remarks, side_rows
from schemas.messages.soccer.league.findings import Findings
from schemas.soccer.game import EventKind, GameStage, Phase, Score
from support.msl_log import START_MS, Log, record, robot
from touchline.commands.cli.command_line import app

PERIOD_MS = 40


@pytest.fixture
def log(tmp_path: Path) -> Log:
    return Log(tmp_path)


def findings(imported: ImportSummary, words: str) -> list[tuple[str, int]]:
    every = [*imported.coped, *imported.lost, *imported.left_out]
    return [(finding.what, finding.count) for finding in every if words in finding.what]


def worlds(recording: Recording) -> list[Any]:
    return [world for _, world in recording.decoded("world")]


def ball(along: float, velocity: Any = (0, 0, 0), confidence: Any = 0.9) -> list[dict[str, Any]]:
    return [{"position": [0.0, along, 0.11], "velocity": list(velocity), "confidence": confidence}]


def shot(time_ms: int) -> float:
    """A ball that lies for a second, rolls at 10 m/s for 0.6 s, and lies again."""
    return min(6.0, max(0.0, (time_ms - 1000) / 100))


def test_a_ball_that_moves_with_a_velocity_of_zero_has_the_velocity_of_its_positions(log: Log) -> None:
    log.write("A", [record(time, balls=ball(shot(time))) for time in range(0, 3001, PERIOD_MS)])
    imported, recording = log.read()
    speeds = {round(world.time, 2): math.hypot(world.ball.vx, world.ball.vy) for world in worlds(recording)}
    assert speeds[1.32] == pytest.approx(10.0, abs=0.1)
    assert speeds[0.52] == speeds[2.52] == pytest.approx(0.0, abs=1e-9)
    ((what, count),) = findings(imported, "velocity of the ball of A contradicts its positions")
    assert "0.0 m/s where it moves" in what
    assert count == len(range(0, 3001, PERIOD_MS))


def test_a_ball_without_a_place_or_far_away_does_not_hide_those_listed_after_it(log: Log) -> None:
    unusable = [{"position": [None, 1.0, 0.11]}, {"position": [1e6, 0.0, 0.11]}]
    log.write("A", [record(time, balls=[*unusable, *ball(2.0)]) for time in range(0, 1001, PERIOD_MS)])
    imported, recording = log.read()
    assert {(round(world.ball.x, 3), round(world.ball.y, 3)) for world in worlds(recording)} == {(2.0, 0.0)}
    assert findings(imported, "ball without a position") and findings(imported, "from the centre")


def test_velocities_in_other_axes_are_derived_from_the_positions(log: Log) -> None:
    """A robot that drives forward at 1 m/s, and says that it drives to its right."""
    times = range(0, 2001, PERIOD_MS)
    log.write("A", [record(time, [robot(2, [0.0, time / 1e3, 0.0], velocity=[1.0, 0.0, 0.0])]) for time in times])
    imported, recording = log.read()
    moving = [world.robots["cyan2"] for world in worlds(recording)]
    assert [(one.vx, one.vy) for one in moving] == [pytest.approx((1.0, 0.0), abs=1e-6)] * len(moving)
    assert findings(imported, "velocity of robot 2 of A contradicts its positions, 1.0 m/s where it moves 1.0 m/s")


def test_velocities_that_fit_the_positions_are_kept_as_they_are(log: Log) -> None:
    times = range(0, 2001, PERIOD_MS)
    log.write(
        "A", [record(time, [robot(2, [0.0, 1.1 * time / 1e3, 0.0], velocity=[0.0, 1.05, 0.0])]) for time in times]
    )
    imported, recording = log.read()
    assert findings(imported, "contradicts") == []
    assert {round(world.robots["cyan2"].vx, 6) for world in worlds(recording)} == {1.05}


def test_single_velocities_of_zero_of_a_moving_body_are_replaced(log: Log) -> None:
    def velocity(time: int) -> list[float]:
        return [0.0, 0.0 if time in (800, 1200) else 2.0, 0.0]

    times = range(0, 2001, PERIOD_MS)
    log.write("A", [record(time, [robot(2, [0.0, time / 500, 0.0], velocity=velocity(time))]) for time in times])
    imported, recording = log.read()
    assert {round(world.robots["cyan2"].vx, 6) for world in worlds(recording)} == {2.0}
    assert findings(imported, "velocity of robot 2 of A contradicts")[0][1] == 2


def test_a_jump_of_the_localisation_is_reported_and_is_neither_speed_nor_distance(log: Log) -> None:
    """A robot that stands, and is 0.78 m away after 40 ms: 19.5 m/s."""

    def place(time: int) -> float:
        return 0.78 if time >= 1000 else 0.0

    times = range(0, 2001, PERIOD_MS)
    log.write("A", [record(time, [robot(2, [0.0, place(time), 0.0], velocity=None)]) for time in times])
    imported, recording = log.read()
    assert findings(imported, "jump of robot 2 of A, up to 19.5 m/s: not counted as motion")[0][1] == 1
    (stats,) = [one for one in figures_of_recording(recording).robots if one.name == "cyan2"]
    assert (stats.top_speed, stats.distance) == pytest.approx((0.0, 0.0))
    assert {round(world.robots["cyan2"].x, 6) for world in worlds(recording)} == {0.0, 0.78}


def received(sent_ms: int) -> int:
    """Five records at a time, 2 ms apart, as a busy network delivers them."""
    return sent_ms // 200 * 200 + 200 + sent_ms % 200 // PERIOD_MS * 2


def test_velocities_are_believed_where_the_times_of_records_are_those_of_bursts(log: Log) -> None:
    """A robot that swings about its place within a second, and whose velocities are right."""

    def swinging(sent_ms: int) -> dict[str, Any]:
        angle = sent_ms / 1e3 * 2 * math.pi
        return robot(2, [0.0, 0.3 * math.sin(angle), 0.0], velocity=[0.0, 0.6 * math.pi * math.cos(angle), 0.0])

    log.write("A", [record(received(time), [swinging(time)]) for time in range(0, 4000, PERIOD_MS)])
    imported, recording = log.read()
    assert findings(imported, "in a burst") and findings(imported, "contradicts") == []
    speeds = [math.hypot(world.robots["cyan2"].vx, world.robots["cyan2"].vy) for world in worlds(recording)]
    assert max(speeds) == pytest.approx(0.6 * math.pi, abs=0.01)


def test_a_velocity_is_derived_from_records_that_are_apart_and_never_above_the_limit(log: Log) -> None:
    """A robot at 1 m/s whose records come in bursts, and one that is 0.3 m away for a moment between two jumps."""
    places = {0: 0.0, 40: 0.0, 41: 0.5, 44: 0.78, 400: 8.0, 440: 8.24, 480: 8.6, 520: 8.9}
    log.write(
        "A", [record(received(time), [robot(2, [0.0, time / 1e3, 0.0], velocity=None)]) for time in range(0, 2000, 40)]
    )
    log.write("B", [record(time, [robot(3, [0.0, place, 0.0], velocity=None)]) for time, place in places.items()])
    imported, recording = log.read()
    speeds = {name: [] for name in ("cyan2", "magenta3")}
    for world in worlds(recording):
        for name, one in world.robots.items():
            speeds[name].append(math.hypot(one.vx, one.vy))
    assert min(speeds["cyan2"]) > 0.3 and max(speeds["cyan2"]) < 2.5
    assert max(speeds["magenta3"]) == pytest.approx(6.0)
    assert findings(imported, "velocity of robot 3 of B up to 7")[0][0].endswith("m/s: taken for 6 m/s")


def test_kicks_that_an_import_did_not_find_are_unknown_and_robots_stand_in_their_order(log: Log) -> None:
    """A goal without a kick: the robot is in no record before the others."""
    times = range(0, 2001, PERIOD_MS)
    log.write("A", [record(time, [robot(3), *([robot(1, [4.0, 0.0, 0.0])] if time > 400 else [])]) for time in times])
    log.events(f"{START_MS},00:00(00:00),1st Half,s,START", f"{START_MS + 1000},00:01(00:01),1st Half,A,CYAN Goal+")
    figures = figures_of_recording(log.read()[1])
    assert [one.name for one in figures.robots] == ["cyan1", "cyan3"]
    rows = {name: cyan for name, cyan, _ in side_rows(figures)}
    assert (rows["goals"], rows["shots on goal"], rows["saves"]) == ("1", "–", "–")
    assert any(one.startswith("kicks are inferred from positions") for one in remarks(figures))


def test_a_confidence_out_of_range_is_unknown_and_does_not_silence_a_team(log: Log) -> None:
    """Magenta's axes are turned by π. While cyan sees no ball, magenta's is believed."""
    log.write("A", [record(time, balls=ball(3.0) if time >= 200 else []) for time in range(0, 401, PERIOD_MS)])
    log.write("B", [record(time, [robot(3)], ball(-3.4, confidence=-100)) for time in range(0, 401, PERIOD_MS)])
    imported, recording = log.read()
    xs = [world.ball.x for world in worlds(recording)]
    assert xs[0] == pytest.approx(3.4)
    assert xs[-1] == pytest.approx(3.2, abs=0.01)
    assert findings(imported, "confidence outside 0 to 1: it is unknown") == [
        ("confidence outside 0 to 1: it is unknown", 11)
    ]


def test_of_two_balls_with_unknown_confidence_the_known_one_is_believed(log: Log) -> None:
    log.write("A", [record(0, balls=ball(3.0, confidence=-100))])
    log.write("B", [record(0, [robot(3)], ball(2.0, confidence=0.1))])
    (world,) = worlds(log.read()[1])
    assert world.ball.x == pytest.approx(-2.0)


def test_data_without_a_place_in_a_recording_is_listed_with_its_number(log: Log) -> None:
    obstacle = {"position": [1, 1], "velocity": [0, 0], "radius": 0.25, "confidence": 1}
    two_balls = [*ball(3.0), *ball(5.0, confidence=0.2)]
    full = {"obstacles": [obstacle] * 3, "balls": two_balls, "ageMs": 20, "strategy": "press"}
    log.write("A", [record(time, [robot(temperature=40)], **full) for time in (0, 40, 80)])
    imported, _ = log.read()
    assert {finding.what: finding.count for finding in imported.left_out} == {
        "obstacles that a team sees": 9,
        "further balls that a team sees": 3,
        "ages of records that are not 0": 3,
        'values of the key "strategy" of a worldstate': 3,
        'values of the key "temperature" of a robot': 3,
    }
    assert imported.to_json()["left_out"][0]["count"] > 0


def test_targets_batteries_and_intentions_are_the_robots_beliefs(log: Log) -> None:
    """The league's (1, −2) is (−2, −1) in the team frame."""
    more = {"targetPose": [0.5, 3.0, 0.2], "batteryLevel": 71.5, "intention": "pass to 4"}
    log.write("A", [record(time, [robot(2, **more)], intention="attack") for time in (0, 40)])
    _, recording = log.read()
    (recorded, belief), _ = recording.decoded("team/cyan/belief/cyan2")
    assert (recorded.time, belief.robot, belief.radio.intention) == (0.0, "cyan2", "pass to 4")
    own = belief.radio.self
    assert (own.x, own.y, own.heading) == pytest.approx((-2.0, -1.0, 0.5))
    assert belief.radio.extra == {
        "target_x": pytest.approx(3.0),
        "target_y": pytest.approx(-0.5),
        "target_heading": pytest.approx(0.2),
        "battery": 71.5,
        "team_intention": "attack",
    }


def line(after_ms: int, part: str, character: str, text: str, clock: str = "00:01(00:01)") -> str:
    return f"{START_MS + after_ms},{clock},{part},{character},{text}"


def test_signals_after_the_last_record_keep_their_times_and_count_in_info_and_stats(log: Log) -> None:
    log.write("A", [record(time) for time in range(0, 2001, PERIOD_MS)])
    log.events(
        line(0, "1st Half", "s", "START"),
        line(1000, "1st Half - STOP", "A", "CYAN Goal+"),
        line(2500, "1st Half - STOP", "a", "MAGENTA Goal+"),
        line(9000, "End Game", "e", "End Game"),
    )
    imported, recording = log.read()
    events = [(recorded.time, event.time) for recorded, event in recording.decoded("game/event")]
    assert events == [(0.0, 0.0), (1.0, 1.0), (2.5, 2.5), (9.0, 9.0)]
    assert findings(imported, "signal after the last record")[0][1] == 2
    figures = figures_of_recording(recording)
    assert recording.result.score == Score(cyan=1, magenta=1)
    assert [side.goals for side in figures.sides.values()] == [1, 1]
    assert len(figures.goals) == 2
    text = CliRunner().invoke(app, ["info", str(imported.out)], prog_name="touchline").stdout
    assert "1 : 1" in text and "contradiction" not in text


def test_the_goals_of_a_shoot_out_count_apart(log: Log) -> None:
    log.write("A", [record(time) for time in range(0, 8001, PERIOD_MS)])
    log.events(
        line(0, "Overtime - 2nd Half", "s", "START"),
        line(1000, "Overtime - 2nd Half - STOP", "A", "CYAN Goal+"),
        line(1500, "Overtime - 2nd Half - STOP", "a", "MAGENTA Goal+"),
        line(2000, "Penalties/STOP", "S", "STOP"),
        line(3000, "Penalties/STOP", "P", "CYAN Penalty Kick"),
        line(4000, "Penalties", "s", "START"),
        line(4500, "Penalties/STOP", "A", "CYAN Goal+"),
        line(5000, "Penalties/STOP", "p", "MAGENTA Penalty Kick"),
        line(6000, "Penalties", "s", "START"),
        line(7000, "End Game", "e", "End Game"),
    )
    _, recording = log.read()
    states = [state for _, state in recording.decoded("game/state")]
    assert states[-1].phase is Phase.FULL_TIME
    assert (states[-1].stage, states[-1].score) == (GameStage.SHOOT_OUT, Score(cyan=1, magenta=1))
    assert states[-1].shoot_out == Score(cyan=1)
    clocks = [state.clock for state in states if state.stage is GameStage.SHOOT_OUT]
    assert clocks[0] == clocks[-1]
    kinds = [event.kind for _, event in recording.decoded("game/event") if event.score is not None]
    assert kinds == [EventKind.GOAL, EventKind.GOAL, EventKind.SHOT]


def patrol(goal_line: float, seconds: float = 8.0) -> list[dict[str, Any]]:
    """A goalkeeper before its goal line, and a robot that drives from one goal to the other."""
    made = []
    for time in range(0, int(seconds * 1e3) + 1, PERIOD_MS):
        along = (goal_line - 1.0) * math.sin(time / 1e3)
        made.append(
            record(
                time, [robot(1, [0.0, 0.4 - goal_line, 0.0], velocity=None), robot(2, [1.0, along, 0.0], velocity=None)]
            )
        )
    return made


@pytest.mark.parametrize(("goal_line", "length"), [(9.0, 18.0), (11.0, 22.0)])
def test_the_pitch_is_recognised_by_how_far_the_robots_go(log: Log, goal_line: float, length: float) -> None:
    log.write("A", patrol(goal_line))
    imported, recording = log.read()
    assert recording.manifest.setup.pitch.length == length
    recognised = findings(imported, "taken for a pitch of 18 × 12 m, profile paper")
    assert bool(recognised) == (length == 18.0)
    assert imported.to_json()["profile"] == ("paper" if length == 18.0 else "msl")


def test_a_pitch_that_does_not_fit_the_log_is_kept_and_hinted_at(log: Log) -> None:
    log.write("A", patrol(9.0))
    imported, recording = log.read(profile="msl")
    assert recording.manifest.setup.pitch.length == 22.0
    assert findings(imported, "does not fit the pitch of 22 × 14 m; --profile paper fits")


def test_the_command_lists_what_was_left_out(log: Log) -> None:
    log.write("A", [record(0, obstacles=[{"position": [1, 1]}] * 4)])
    result = CliRunner().invoke(app, ["import", str(log.folder)], prog_name="touchline")
    assert result.exit_code == 0
    assert "left out, a recording has no place for it:" in result.stdout
    assert "4  obstacles that a team sees (first: A, record 1)" in result.stdout
    assert open_recording(log.folder.with_suffix(".mcap")).complete


def test_the_boxs_clock_of_a_half_counts_where_it_is_ahead_of_the_log(log: Log) -> None:
    """The clock stands from a signal of 9 s after the first half's 2 s on, one second of the second half later."""
    log.write("A", [record(time) for time in range(0, 6001, PERIOD_MS)])
    log.events(
        line(0, "1st Half", "s", "START", "00:00(00:00)"),
        line(2000, "Halftime", "h", "Halftime", "00:02(00:02)"),
        line(3000, "2nd Half", "k", "MAGENTA Kickoff", "00:00(00:00)"),
        line(3000, "2nd Half", "s", "START", "00:00(00:00)"),
        line(4000, "2nd Half", "S", "STOP", "00:09(00:09)"),
        line(5000, "2nd Half", "s", "START", "00:02(00:02)"),
        line(6000, "End Game", "e", "End Game", "00:12(00:12)"),
    )
    _, recording = log.read()
    clocks = {round(state.time): state.clock for _, state in recording.decoded("game/state")}
    assert [clocks[time] for time in (3, 4, 5, 6)] == pytest.approx([2.0, 11.0, 12.0, 14.0])


@pytest.mark.parametrize(
    ("part", "half"),
    [("1st half", 1), ("2nd Half/STOP", 2), ("Overtime 1st half", 3), ("2ND HALF OVERTIME", 4), ("Pre-Game", 0)],
)
def test_a_signal_belongs_to_the_half_that_its_line_names(part: str, half: int) -> None:
    (signal,) = read_events(f"1000,00:10,{part},S,stop", TeamNames("Cyan", "Magenta"), Findings())
    assert signal.half == half
