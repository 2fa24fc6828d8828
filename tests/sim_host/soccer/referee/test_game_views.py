"""The game from one team's point of view."""

import pytest

from schemas.messages.soccer.game import GameView
from schemas.side import Side
from schemas.soccer.game import Point, TeamPhase
from sim_host.soccer.referee.game_views import game_views


@pytest.mark.parametrize("halves_over", [0, 1])
def test_both_teams_see_a_corner_at_the_end_its_taker_attacks(rig, halves_over):
    rig.playing()
    if halves_over:
        rig.ask("end_half")
        rig.until(lambda state: state.half == 2)
        rig.playing()
    rig.ask("goal", Side.MAGENTA)
    rig.ask("corner", Side.CYAN)
    rig.until(lambda state: state.spot is not None)
    inset = rig.book.restarts.corner_inset
    ours, theirs = game_views(rig.state, rig.roster).values()
    assert (ours.phase, theirs.phase) == (TeamPhase.OUR_CORNER, TeamPhase.THEIR_CORNER)
    assert (ours.our_score, ours.their_score) == (theirs.their_score, theirs.our_score) == (0, 1)
    assert ours.spot.x == pytest.approx(rig.pitch.goal_line - inset)
    assert theirs.spot == Point(x=-ours.spot.x, y=-ours.spot.y)
    assert ours.half == rig.state.half and ours.clock == rig.state.clock and not ours.running
    rig.ask("yellow_card", robot="cyan2")
    published, roster = rig.state.game_state(700, 14.0), rig.roster
    for side, view in game_views(rig.state, rig.roster).items():
        robots = [name for name, its in zip(roster.names, roster.sides, strict=True) if its is side]
        assert GameView.of(published, side, robots) == view


def test_in_play_both_see_the_same_and_no_spot(rig):
    rig.playing()
    cyan, magenta = game_views(rig.state, rig.roster).values()
    assert cyan == magenta and cyan.phase is TeamPhase.PLAY and cyan.running and cyan.spot is None
