"""A league's referee box officiates: no rule of time ends a period, and cards without a robot ask the side for one."""

from typing import Any

import pytest

from schemas.side import Side
from schemas.soccer.game import REFBOX, GameStage, OfficiatingMode, Phase, Score
from support.referee_rig import RefereeRig

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
BREAKS = (Phase.PARKING, Phase.HALF_TIME)


@pytest.fixture
def box() -> RefereeRig:
    """A match in manual officiating with halves of 10 s, under a referee box."""
    return new_box()


def new_box(**options: Any) -> RefereeRig:
    rig = RefereeRig("msl", **{"mode": OfficiatingMode.MANUAL, "duration": 20.0, "dt": 0.1, **options})
    rig.refbox = True
    return rig


def say(rig: RefereeRig, name: str, side: Side | None = None, **more: Any) -> str:
    """An action of the box; the reason of its refusal, or nothing."""
    (reply,) = rig.ask(name, side, **{"source": REFBOX, **more}).replies
    return reply.reason


def play(rig: RefereeRig, name: str = "kick_off", side: Side | None = CYAN) -> None:
    """The box gives a restart, and START until the game runs."""
    say(rig, name, side)
    while not rig.state.running:
        say(rig, "start")


def texts(rig: RefereeRig) -> str:
    return "\n".join(event.text for event in rig.events)


def test_the_clock_ends_no_half_and_a_restart_of_the_box_stays_as_it_was_given(box: RefereeRig) -> None:
    """At the end of our half, just as the box gives a throw-in."""
    play(box)
    box.run(9.0)
    say(box, "stop")
    say(box, "throw_in", MAGENTA)
    box.run(5.0)
    assert (box.state.phase, box.state.side, box.state.half) == (Phase.THROW_IN, MAGENTA, 1)
    say(box, "start")
    assert box.state.running and box.state.half == 1
    box.run(20.0)
    assert box.state.half == 1 and box.state.clock > 30.0


@pytest.mark.parametrize("mode", list(OfficiatingMode))
def test_the_clock_ends_no_half_however_our_referee_officiates(mode: OfficiatingMode) -> None:
    rig = new_box(mode=mode)
    play(rig)
    rig.run(25.0)
    assert rig.state.half == 1 and rig.state.phase not in BREAKS


def test_the_match_does_not_begin_by_itself(box: RefereeRig) -> None:
    box.run(30.0)
    assert box.state.phase is Phase.PRE_GAME


def test_a_break_lasts_until_the_box_ends_it(box: RefereeRig) -> None:
    play(box)
    say(box, "stop")
    say(box, "end_half")
    box.run(600.0)
    assert box.state.phase is Phase.HALF_TIME and box.state.timing.left is None
    play(box, side=MAGENTA)
    assert (box.state.half, box.state.cyan_attacks) == (2, -1)
    box.run(20.0)
    assert box.state.half == 2 and box.state.phase not in BREAKS


def test_without_a_winner_required_the_match_is_over_after_the_second_half_unless_the_box_goes_on() -> None:
    for goes_on in (False, True):
        rig = new_box()
        play(rig)
        say(rig, "end_half")
        play(rig, side=MAGENTA)
        say(rig, "end_half")
        assert rig.state.phase is Phase.PARKING
        if goes_on:
            play(rig)
            assert (rig.state.half, rig.state.stage) == (3, GameStage.EXTRA_TIME)
        rig.run(60.0)
        assert (rig.state.phase is Phase.FULL_TIME) is not goes_on


def test_a_level_match_waits_for_the_box_to_begin_extra_time_and_the_shoot_out() -> None:
    rig = new_box(winner=True)
    for half, side in enumerate((CYAN, MAGENTA, CYAN, MAGENTA), 1):
        rig.run(400.0)
        assert rig.state.phase is not Phase.FULL_TIME
        play(rig, side=side)
        rig.run(30.0)
        assert (rig.state.half, rig.state.running) == (half, True)
        say(rig, "end_half")
    rig.run(400.0)
    play(rig, "penalty", CYAN)
    assert rig.state.stage is GameStage.SHOOT_OUT and rig.state.side is CYAN


def test_a_shoot_out_is_counted_and_ended_by_the_box_alone() -> None:
    """The box gives STOP first, and the goal after it; neither the limit of 30 s nor a lead ends anything."""
    rig = new_box(winner=True)
    for side in (CYAN, MAGENTA, CYAN, MAGENTA):
        play(rig, side=side)
        say(rig, "end_half")
    for kick in range(6):
        for side in (CYAN, MAGENTA):
            play(rig, "penalty", side)
            rig.run(40.0)
            assert rig.state.running
            say(rig, "stop")
            if side is CYAN:
                assert say(rig, "goal", CYAN) == ""
                assert "has scored all of its" in say(rig, "goal", CYAN)
            assert rig.state.shoot_out is not None and rig.state.shoot_out.goals == Score(cyan=kick + 1)
    say(rig, "cancel_goal", CYAN)
    assert rig.state.shoot_out is not None and rig.state.shoot_out.goals == Score(cyan=5)
    say(rig, "start")
    assert (rig.state.phase, rig.state.side) == (Phase.PENALTY, CYAN)
    say(rig, "end_game")
    assert rig.state.phase is Phase.FULL_TIME and rig.state.score == Score()


def test_no_side_forfeits(box: RefereeRig) -> None:
    play(box)
    for number in range(1, 6):
        say(box, "red_card", robot=f"cyan{number}")
    box.run(5.0)
    assert box.state.running


def test_the_clocks_rules_come_back_ten_seconds_after_the_box_has_gone(box: RefereeRig) -> None:
    """A link that is made again in time changes nothing; a half whose time is up ends as soon as they are back."""
    play(box)
    box.run(15.0)
    box.refbox = False
    box.run(9.9)
    box.refbox = True
    box.run(5.0)
    box.refbox = False
    box.run(9.9)
    assert box.state.half == 1 and box.state.running and box.state.game_state(1, 0.0).refbox
    box.run(0.2)
    assert box.state.phase is Phase.PARKING and not box.state.game_state(1, 0.0).refbox
    assert texts(box).index("box officiates") < texts(box).index("has been gone for 10 s") < texts(box).index("half 1")
    box.run(60.0)
    assert box.state.half == 2


def test_a_half_whose_time_is_not_up_goes_on_after_the_box_has_gone() -> None:
    rig = new_box(duration=80.0)
    play(rig)
    rig.refbox = False
    rig.run(30.0)
    assert rig.state.phase is not Phase.PARKING and not rig.state.refbox_decides
    rig.until(lambda state: state.phase is Phase.PARKING, 15.0)
    assert rig.state.clock == pytest.approx(40.0)


def test_a_box_that_comes_during_a_break_takes_its_limit_away_and_gives_it_back(box: RefereeRig) -> None:
    box.refbox = False
    play(box)
    say(box, "end_half")
    box.until(lambda state: state.phase is Phase.HALF_TIME)
    assert box.state.timing.left is not None
    box.refbox = True
    box.run(100.0)
    assert box.state.phase is Phase.HALF_TIME and box.state.timing.left is None
    box.refbox = False
    box.run(10.5)
    assert box.state.half == 2


def test_undo_after_the_half_would_have_ended_is_allowed_and_does_not_send_the_box_away(box: RefereeRig) -> None:
    play(box)
    box.run(15.0)
    say(box, "goal", CYAN)
    assert say(box, "undo") == ""
    assert box.state.score == Score() and box.state.refbox_decides
