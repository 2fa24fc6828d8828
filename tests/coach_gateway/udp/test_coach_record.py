"""The words and numbers of the NuBot coach record, both ways."""

import pytest

from coach_gateway.udp.coach_record import (
    BY_NUMBER,
    FOR_COACH,
    TEST_MODES,
    MatchMode,
    Meaning,
    RecordedTest,
    for_referee,
)
from schemas.messages.coach import CoachMode, CoachTest
from schemas.side import Side
from schemas.soccer.game import ActionName, TeamPhase

RECORD = {
    **{0: "stop", 1: "our_kick_off", 2: "their_kick_off", 3: "our_throw_in", 4: "their_throw_in", 5: "our_penalty"},
    **{6: "their_penalty", 7: "our_goal_kick", 8: "their_goal_kick", 9: "our_corner", 10: "their_corner"},
    **{11: "our_free_kick", 12: "their_free_kick", 13: "drop_ball", 15: "start", 25: "park", 27: "test"},
}
TESTS = {
    **{0: ("stop", False, False), 2: ("pass", False, False), 3: ("catch", False, False), 4: ("shoot", False, False)},
    **{5: ("location", False, False), 6: ("circle", False, False), 10: ("move", False, False)},
    **{11: ("move", False, True), 12: ("move", True, False), 13: ("move", True, True)},
}


def test_every_match_mode_has_its_number_and_every_number_its_match_mode() -> None:
    assert {mode.number: mode.value for mode in MatchMode} == RECORD
    for number, word in RECORD.items():
        assert BY_NUMBER[number] is MatchMode(word)
        assert BY_NUMBER[number].number == number
    assert 14 not in BY_NUMBER


def test_every_test_mode_has_its_number_and_every_number_its_test_mode() -> None:
    assert {number: (mode.test.value, mode.with_ball, mode.avoid) for number, mode in TEST_MODES.items()} == TESTS
    assert len(set(TEST_MODES.values())) == len(TEST_MODES)
    assert RecordedTest(CoachTest.MACHINE) not in TEST_MODES.values()


def test_what_is_played_has_a_match_mode_and_a_restart_the_one_of_its_name() -> None:
    for phase in TeamPhase:
        mode = MatchMode.of_game(phase, running=False)
        if phase.ours or phase.theirs:
            assert mode.value == phase.value
    stopped = (TeamPhase.PRE_GAME, TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.FULL_TIME)
    assert {MatchMode.of_game(phase, running=False) for phase in stopped} == {MatchMode.STOP}
    assert MatchMode.of_game(TeamPhase.DROP_BALL, running=False) is MatchMode.DROP_BALL
    assert MatchMode.of_game(TeamPhase.PARKING, running=False) is MatchMode.PARK
    assert MatchMode.of_game(TeamPhase.OUR_CORNER, running=True) is MatchMode.START
    assert MatchMode.of_game(TeamPhase.PLAY, running=True) is MatchMode.START


@pytest.mark.parametrize("own", list(Side))
def test_the_referee_brings_about_every_match_mode_from_a_sides_point_of_view(own: Side) -> None:
    meanings = {mode: for_referee(mode, own) for mode in MatchMode}
    assert meanings[MatchMode.STOP] == Meaning(ActionName.STOP)
    assert meanings[MatchMode.START] == Meaning(ActionName.START)
    assert meanings[MatchMode.DROP_BALL] == Meaning(ActionName.DROP_BALL)
    assert meanings[MatchMode.OUR_CORNER] == Meaning(ActionName.CORNER, own)
    assert meanings[MatchMode.THEIR_KICK_OFF] == Meaning(ActionName.KICK_OFF, own.opponent)
    assert meanings[MatchMode.PARK] == Meaning(order=CoachMode.PARK)
    assert [mode for mode, meaning in meanings.items() if meaning is None] == [MatchMode.TEST]


def test_a_sides_coach_stops_starts_and_parks_its_own_robots_and_nothing_more() -> None:
    orders = {mode: meaning.order for mode, meaning in FOR_COACH.items()}
    assert orders == {MatchMode.STOP: CoachMode.HOLD, MatchMode.START: CoachMode.PLAY, MatchMode.PARK: CoachMode.PARK}
