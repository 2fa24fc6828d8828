import pytest

from coach_gateway.match.follower import MatchFollower
from coach_gateway.match.team_names import TeamNames
from schemas.messages.health import Health, RobotHealth
from schemas.messages.recorder import RecorderProgress
from schemas.messages.soccer.game import DisciplinaryRecord, GameState
from schemas.side import Side
from schemas.soccer.game import GameStage, OffField, Phase, Score
from schemas.topics import RECORDER_PROGRESS
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from touchline.launch.terminal.status_line import robots_text, status_line


def health(tick: int, **silent_robots: RobotHealth) -> Health:
    robots = {"cyan1": RobotHealth(alive=True, answering=True), **silent_robots}
    return Health(tick=tick, time=0.0, pace="lockstep", real_time_factor=6.25, robots=robots)


def view() -> MatchFollower:
    return MatchFollower(SharedState().open_bus("friendly", SteppedClock()))


def test_before_the_host_speaks_it_is_waited_for() -> None:
    assert status_line(view(), 10) == "waiting for the host"


def test_before_the_first_tick_the_missing_robots_are_named() -> None:
    waiting = view()
    waiting.health = health(0, cyan2=RobotHealth())
    assert status_line(waiting, 2) == "waiting for the robots  robots 1/2 (missing: cyan2)"


def test_while_it_is_played_clock_score_phase_speed_and_robots_stand_in_one_line() -> None:
    playing = view()
    playing.state = GameState(
        tick=9, time=61.0, clock=61.0, phase=Phase.CORNER, side=Side.CYAN, score=Score(cyan=1, magenta=2)
    )
    playing.health = health(9)
    assert status_line(playing, 1) == " 1:01.0  half 1  cyan 1 : 2 magenta  corner, cyan  ×6.2  robots 1/1"


def test_teams_with_names_have_them_in_the_line() -> None:
    playing = view()
    playing.state = GameState(tick=9, time=61.0, clock=61.0, phase=Phase.CORNER, side=Side.CYAN, score=Score(cyan=1))
    line = status_line(playing, 1, TeamNames("Lions", "NuBot"))
    assert line == " 1:01.0  half 1  Lions 1 : 0 NuBot  corner, Lions"


def test_what_a_recorder_misses_stands_in_the_line_by_key() -> None:
    playing = view()
    playing.state = GameState(tick=9, time=61.0, clock=61.0, phase=Phase.PLAY)
    writer = playing.bus.publisher(RECORDER_PROGRESS, name="recorder")
    writer.put(RecorderProgress(tick=9, messages=70, lost=0))
    playing.update()
    assert "lost" not in status_line(playing, 1)
    writer.put(RecorderProgress(tick=9, messages=70, lost=5, losses={"world": 2, "robot/cyan1/command": 3}))
    playing.update()
    assert status_line(playing, 1).endswith("lost 5 (robot/cyan1/command 3, world 2)")


def test_cards_and_robots_off_the_field_stand_in_the_line() -> None:
    playing = view()
    playing.state = GameState(
        tick=9,
        time=61.0,
        clock=61.0,
        phase=Phase.PLAY,
        half=3,
        stage=GameStage.EXTRA_TIME,
        robots={
            "cyan3": DisciplinaryRecord(yellow=1),
            "magenta2": DisciplinaryRecord(red=1, off_field=OffField.RED_CARD),
            "magenta4": DisciplinaryRecord(off_field=OffField.REPAIR, left=12.4),
        },
    )
    assert status_line(playing, 1) == (
        " 1:01.0  extra time, half 3  cyan 0 : 0 magenta  play  "
        "[cyan3 1 yellow; magenta2 1 red, off: red card; magenta4 off: repair 12 s]"
    )


def test_a_shoot_out_shows_its_own_score() -> None:
    playing = view()
    playing.state = GameState(
        tick=9,
        time=9.0,
        phase=Phase.PENALTY,
        side=Side.CYAN,
        stage=GameStage.SHOOT_OUT,
        shoot_out=Score(cyan=4, magenta=3),
    )
    assert "penalties 4 : 3" in status_line(playing, 1)


def test_a_robot_that_is_alive_and_does_not_answer_is_named_silent() -> None:
    assert robots_text(health(9, cyan2=RobotHealth(alive=True)), 2) == "robots 1/2 (silent: cyan2)"


@pytest.mark.parametrize(("silent", "words"), [(4, "r1, r2, r3, r4"), (6, "r1, r2, r3, r4, 2 more")])
def test_many_silent_robots_are_counted(silent: int, words: str) -> None:
    robots = {f"r{n}": RobotHealth() for n in range(1, silent + 1)}
    assert robots_text(health(9, **robots), silent + 1) == f"robots 1/{silent + 1} (silent: {words})"


def test_a_robot_that_stands_still_in_its_scene_is_not_missed() -> None:
    said = health(9, magenta1=RobotHealth(still=True))
    assert robots_text(said, 1) == "robots 1/1"


def test_agents_that_do_not_keep_up_stand_in_the_line_with_their_figures() -> None:
    playing = view()
    playing.state = GameState(tick=9, time=61.0, clock=61.0, phase=Phase.PLAY)
    slow = {f"magenta{number}": RobotHealth(alive=True, answering=True, latency_ms=310.0) for number in (1, 2)}
    fault = "answers tick 0, the match is at 9; use sight.tick"
    playing.health = health(9, cyan2=RobotHealth(alive=True, fault=fault), **slow)
    assert status_line(playing, 4).endswith(
        f"robots 3/4 (silent: cyan2)  cyan2 {fault}  magenta2 takes 310 ms a tick  1 more"
    )


def test_silent_robots_are_named_with_the_ticks_they_have_missed() -> None:
    playing = health(
        90,
        cyan2=RobotHealth(alive=True, missed=80, missed_in_a_row=57),
        magenta1=RobotHealth(alive=True, missed=1, missed_in_a_row=1),
    )
    assert robots_text(playing, 3) == "robots 1/3 (silent: cyan2 57 ticks, magenta1 1 tick)"
