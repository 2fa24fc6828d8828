"""The game without a host: what each action makes of it, and what time does."""

import pytest

from coach_gateway.soccer.without_host.game import GameWithoutHost
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, GameStage, OffField, Phase, Score
from support.messages import make_setup


class Played:
    """A game, acted on with one word after the other."""

    def __init__(self, **match):
        self.game = GameWithoutHost(make_setup(rules="msl", **match))

    def act(self, *words):
        """Carry out `action`, `action side` or `action robot`; what was refused."""
        refused = []
        for word in words:
            name, _, more = word.partition(" ")
            whom = {"side": Side(more)} if more in ("cyan", "magenta") else {"robot": more or None}
            refused += filter(None, [self.game.act(RefereeAction(action=ActionName(name), **whom))])
        return refused

    def after(self, seconds):
        self.game.advance(self.game.state.time + seconds)
        return self.game.state

    @property
    def now(self):
        state = self.game.state
        return state.phase, state.side, state.running


@pytest.fixture
def played():
    return Played()


def test_start_lets_play_begin_and_stop_ends_it(played):
    assert played.now == (Phase.PRE_GAME, None, False)
    assert played.act("start") == [] and played.now == (Phase.PLAY, None, True)
    assert played.act("start") == ["the game is running"]
    assert played.act("stop") == [] and played.now == (Phase.STOPPED, None, False)


def test_a_restart_waits_for_start_and_is_play_once_the_ball_has_to_be_in_play(played):
    played.act("start", "stop", "corner magenta")
    assert played.now == (Phase.CORNER, Side.MAGENTA, False)
    assert played.after(60.0).phase is Phase.CORNER
    played.act("start")
    limit = make_setup(rules="msl").restarts.time_limit
    assert played.after(limit - 0.5).left == pytest.approx(0.5)
    assert played.now == (Phase.CORNER, Side.MAGENTA, True)
    assert played.after(0.5).left is None and played.now == (Phase.PLAY, None, True)


def test_a_penalty_has_its_own_limit(played):
    played.act("penalty cyan", "start")
    assert played.game.state.left == make_setup(rules="msl").restarts.penalty_limit


def test_the_clock_runs_from_the_first_start_of_a_half_to_its_end_and_effective_time_in_play_only(played):
    assert played.after(5.0).clock == 0.0
    played.act("start")
    played.after(7.0)
    played.act("stop")
    state = played.after(2.0)
    assert (state.clock, state.effective, state.time, state.tick) == (9.0, 7.0, 14.0, 700)
    played.act("end_half")
    assert played.after(100.0).clock == 9.0


def test_goals_count_and_none_is_taken_that_was_not_scored(played):
    assert played.act("goal cyan", "goal magenta", "goal cyan", "cancel_goal cyan") == []
    assert played.game.state.score == Score(cyan=1, magenta=1)
    played.act("cancel_goal cyan")
    assert played.act("cancel_goal cyan", "goal") == ["cancel_goal needs a side with a goal", "goal needs a side"]


def test_cards_and_repairs_take_a_robot_off_until_it_enters(played):
    assert played.act("yellow_card cyan2", "repair cyan3", "double_yellow magenta2") == []
    records = played.game.state.robots
    assert {name: one.off_field for name, one in records.items()} == {
        "cyan2": None,
        "cyan3": OffField.REPAIR,
        "magenta2": OffField.SECOND_YELLOW,
    }
    played.act("yellow_card cyan3")
    assert played.game.state.robots["cyan3"].off_field is OffField.REPAIR
    played.act("enter cyan3", "enter magenta2", "enter magenta3", "red_card cyan2")
    records = played.game.state.robots
    assert {name: (one.yellow, one.red) for name, one in records.items()} == {
        "cyan2": (1, 1),
        "cyan3": (1, 0),
        "magenta2": (1, 0),
    }
    assert [name for name, one in records.items() if one.off_field] == ["cyan2"]


def test_what_nobody_can_judge_without_a_host_and_what_names_nobody_is_refused(played):
    assert played.act("undo", "kick_off", "red_card cyan", "repair cyan77") == [
        "undo needs a host, which sees ball and robots",
        "kick_off needs a side",
        "red_card needs the name of a robot",
        "repair needs the name of a robot",
    ]


def test_a_match_of_two_halves_changes_ends_and_is_over(played):
    assert played.act("end_half") == ["no half has begun, the phase is pre_game"]
    played.act("start", "end_half")
    assert played.now == (Phase.HALF_TIME, None, False)
    assert played.act("corner cyan", "stop", "end_half") == 2 * ["no half has begun, the phase is half_time"]
    played.act("start")
    state = played.game.state
    assert (state.half, state.cyan_attacks, played.now) == (2, -1, (Phase.STOPPED, None, False))
    played.act("kick_off magenta", "start", "end_half")
    assert played.now == (Phase.FULL_TIME, None, False)
    assert played.act("start") == ["nothing can be started, the phase is full_time"]


def test_a_level_match_that_needs_a_winner_goes_on_with_extra_time_and_penalties():
    played, stages = Played(**{"referee.winner": True}), []
    for _ in range(5):
        played.act("kick_off cyan", "start")
        stages.append((played.game.state.half, played.game.state.stage))
        played.act("end_half", "start")
    assert stages == [
        (1, GameStage.REGULAR),
        (2, GameStage.REGULAR),
        (3, GameStage.EXTRA_TIME),
        (4, GameStage.EXTRA_TIME),
        (4, GameStage.SHOOT_OUT),
    ]
    assert played.game.state.phase is Phase.FULL_TIME


def test_a_goal_that_is_counted_in_the_break_may_end_a_match_that_needs_a_winner():
    played = Played(**{"referee.winner": True})
    played.act("start", "end_half", "start", "start", "end_half")
    assert played.now[0] is Phase.HALF_TIME
    played.act("goal cyan", "start")
    state = played.game.state
    assert (state.phase, state.half, state.stage) == (Phase.FULL_TIME, 2, GameStage.REGULAR)


def test_goals_of_the_shoot_out_count_apart_and_end_a_level_match():
    played = Played(**{"referee.winner": True})
    played.act(*4 * ("start", "start", "end_half"), "start", "penalty magenta", "start", "goal magenta")
    state = played.game.state
    assert (state.stage, state.score, state.shoot_out) == (GameStage.SHOOT_OUT, Score(), Score(magenta=1))
    assert played.after(3.0).clock == 0.0


def test_end_game_ends_it_in_any_half(played):
    played.act("start", "end_game")
    assert played.now == (Phase.FULL_TIME, None, False)
