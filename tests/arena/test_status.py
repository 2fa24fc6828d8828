import pytest

from arena.status import robots_words, status_line
from coach_gateway.view import MatchView
from schemas.bus.in_process import Medium
from schemas.clock import SteppedClock
from schemas.game import GameState, Phase, Score
from schemas.host import Health, RobotHealth
from schemas.side import Side


def health(tick: int, **silent_robots: RobotHealth) -> Health:
    robots = {"cyan1": RobotHealth(alive=True, answering=True), **silent_robots}
    return Health(tick=tick, time=0.0, pace="lockstep", real_time_factor=6.25, robots=robots)


def view() -> MatchView:
    return MatchView(Medium().seat("friendly", SteppedClock()))


def test_before_the_host_speaks_it_is_waited_for() -> None:
    assert status_line(view(), 10) == "waiting for the host"


def test_before_the_first_tick_the_missing_robots_are_named() -> None:
    waiting = view()
    waiting.health = health(0, cyan2=RobotHealth())
    assert status_line(waiting, 2) == "waiting for everybody  robots 1/2 (missing: cyan2)"


def test_while_it_is_played_clock_score_phase_speed_and_robots_stand_in_one_line() -> None:
    playing = view()
    playing.state = GameState(
        tick=9, time=61.0, clock=61.0, phase=Phase.CORNER, side=Side.CYAN, score=Score(cyan=1, magenta=2)
    )
    playing.health = health(9)
    assert status_line(playing, 1) == " 1:01.0  cyan 1 : 2 magenta  corner, cyan  ×6.2  robots 1/1"


def test_a_robot_that_is_alive_and_does_not_answer_is_named_silent() -> None:
    assert robots_words(health(9, cyan2=RobotHealth(alive=True)), 2) == "robots 1/2 (silent: cyan2)"


@pytest.mark.parametrize(("silent", "words"), [(4, "r1, r2, r3, r4"), (6, "r1, r2, r3, r4, 2 more")])
def test_many_silent_robots_are_counted(silent: int, words: str) -> None:
    robots = {f"r{n}": RobotHealth() for n in range(1, silent + 1)}
    assert robots_words(health(9, **robots), silent + 1) == f"robots 1/{silent + 1} (silent: {words})"
