"""Taking a restart: who may touch the ball when, how it comes into play, and when a goal counts (MSL rule book 2016).

Each table holds the least case that breaks a rule and the nearest that does not.
"""

import pytest

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase, Score

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
SPOT = (2.0, 1.0)


def taken(rig, phase="free_kick", side=CYAN, spot=SPOT):
    """A restart of a side has been started and no robot has touched the ball."""
    rig.playing()
    rig.ask(phase, side, None if phase in ("penalty", "kick_off") else spot)
    rig.until(lambda state: state.running)
    rig.events.clear()
    return rig


def kick(rig, taker="cyan2", away=0.0):
    """The taker kicks, and the ball rolls so far in the next tick."""
    x, y = rig.state.spot
    rig.tick((x, y), [taker], kicked=taker)
    rig.run(0.2)
    return rig.tick((x + away, y))


def fouls(rig):
    return [event for event in rig.events if event.kind is EventKind.FOUL]


@pytest.mark.parametrize(("rolled", "in_play"), [(0.49, False), (0.51, True)])
def test_the_ball_is_in_play_after_half_a_metre_of_free_roll(rig, rolled, in_play):
    kick(taken(rig), away=rolled)
    assert (rig.state.phase is Phase.PLAY) == in_play
    if in_play:
        assert "0.51 m" in rig.events[-1].text


def test_way_that_the_ball_is_touched_on_is_no_free_roll(rig):
    """Five contacts 0.15 m apart: the ball has moved far, and never rolled freely (a bump, then another)."""
    taken(rig)
    x, y = rig.state.spot
    for step in range(2):
        rig.tick((x, y + 0.15 * step), ["cyan2"])
    rig.tick((x, y + 0.55))
    assert rig.state.phase is Phase.FREE_KICK
    rig.tick((x, y + 0.66))
    assert rig.state.phase is Phase.PLAY


@pytest.mark.parametrize(("moved", "is_foul"), [(0.19, False), (0.21, True)])
def test_a_ball_that_is_dragged_gives_the_restart_away(rig, moved, is_foul):
    taken(rig)
    x, y = rig.state.spot
    rig.tick((x + moved, y), ["cyan2"])
    assert bool(fouls(rig)) == is_foul
    if is_foul:
        (foul,) = fouls(rig)
        assert (foul.rule, foul.robot, foul.unit, foul.limit) == ("dragged", "cyan2", "m", 0.2)
        assert foul.measured == pytest.approx(0.21) and "0.21 m" in foul.text and "limit 0.20 m" in foul.text
        assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, MAGENTA)


@pytest.mark.parametrize(("rolled", "is_foul"), [(0.49, True), (0.51, False)])
def test_the_taker_may_touch_again_once_the_ball_is_in_play(rig, rolled, is_foul):
    kick(taken(rig), away=rolled)
    rig.tick(rig.ball, ["cyan2"])
    assert [foul.rule for foul in fouls(rig)] == (["double_touch"] if is_foul else [])
    if is_foul:
        (foul,) = fouls(rig)
        assert foul.measured == pytest.approx(rolled)
        assert (foul.place.x, foul.place.y) == pytest.approx(rig.ball[:2])
        assert rig.state.pending.side is MAGENTA


def test_contacts_of_the_kick_itself_are_no_second_touch(rig):
    taken(rig)
    rig.tick(rig.state.spot, ["cyan2"], kicked="cyan2")
    rig.tick(rig.ball, ["cyan2"])
    assert fouls(rig) == [] and rig.state.phase is Phase.FREE_KICK


@pytest.mark.parametrize(("rolled", "is_foul"), [(0.49, True), (0.51, False)])
@pytest.mark.parametrize(("robot", "next_side"), [("cyan3", MAGENTA), ("magenta3", CYAN)])
def test_others_may_touch_once_the_ball_is_in_play(rig, robot, next_side, rolled, is_foul):
    """A teammate's early touch gives the restart away, an opponent's has it repeated."""
    kick(taken(rig), away=rolled)
    rig.tick(rig.ball, [robot])
    assert [(foul.rule, foul.robot) for foul in fouls(rig)] == ([("early_touch", robot)] if is_foul else [])
    if is_foul:
        assert rig.state.pending.side is next_side


@pytest.mark.parametrize(
    ("phase", "becomes"),
    [
        ("throw_in", Phase.THROW_IN),
        ("kick_off", Phase.KICK_OFF),
        ("corner", Phase.FREE_KICK),
        ("goal_kick", Phase.FREE_KICK),
    ],
)
def test_a_fouled_throw_in_and_kick_off_stay_what_they_are_for_the_other_side(rig, phase, becomes):
    taken(rig, phase)
    rig.tick(rig.state.spot, ["cyan2"])
    rig.tick(rig.ball, ["cyan3"])
    assert (rig.state.pending.phase, rig.state.pending.side) == (becomes, MAGENTA)


@pytest.mark.parametrize(("phase", "limit"), [("free_kick", "time_limit"), ("penalty", "penalty_limit")])
def test_after_the_limit_anybody_may_take_it(rig, phase, limit):
    """7 s, at a penalty 10 s: the other side may then score directly, the taker's still needs two robots."""
    taken(rig, phase)
    rig.run(getattr(rig.book.restarts, limit) - 0.1)
    assert rig.state.phase is not Phase.PLAY and rig.state.timing.left == pytest.approx(0.1)
    rig.run(0.12)
    assert rig.state.phase is Phase.PLAY
    rig.tick(rig.ball, ["magenta2"])
    assert fouls(rig) == []


def shot(rig, end=1, touches=()):
    line = rig.pitch.goal_line
    rig.tick((end * (line - 0.1), 0.0), touches)
    return rig.tick((end * (line + 0.3), 0.0))


def test_a_direct_goal_from_a_free_kick_does_not_count_and_is_a_goal_kick(rig):
    kick(taken(rig), away=1.0)
    ruling = shot(rig)
    assert ruling.events[0].kind is EventKind.NO_GOAL and (ruling.events[0].measured, ruling.events[0].limit) == (1, 2)
    assert ruling.state.score == Score() and ruling.state.pending[:2] == (Phase.GOAL_KICK, MAGENTA)
    assert (ruling.events[0].side, ruling.events[0].robot) == (CYAN, "cyan2")


@pytest.mark.parametrize(("rules", "cards"), [("china-sim-2020", [("cyan2", Card.YELLOW)]), ("msl", [])])
def test_a_direct_goal_is_a_yellow_card_for_the_kicker_where_the_rule_book_says_so(new_rig, rules, cards):
    rig = taken(new_rig(rules=rules))
    kick(rig, away=1.0)
    ruling = shot(rig)
    assert ruling.events[0].kind is EventKind.NO_GOAL
    rig.run(1.0)
    assert [(event.robot, event.card) for event in rig.events if event.kind is EventKind.CARD] == cards


@pytest.mark.parametrize(("touches", "counts"), [(["cyan3"], True), (["cyan2"], False), (["magenta3"], False)])
def test_a_goal_counts_after_a_second_robot_of_the_side_has_touched(rig, touches, counts):
    kick(taken(rig), away=1.0)
    ruling = shot(rig, touches=touches)
    assert (ruling.events[0].kind is EventKind.GOAL) == counts


def test_once_the_other_side_has_won_the_ball_nothing_of_the_restart_binds_anybody(rig):
    kick(taken(rig), away=1.0)
    rig.tick(rig.ball, ["magenta3"], possession="magenta3")
    assert rig.state.set_piece is None
    assert shot(rig, touches=["cyan2"]).events[0].kind is EventKind.GOAL


def test_the_other_side_scores_directly(rig):
    taken(rig).run(7.1)
    assert shot(rig, end=-1, touches=["magenta2"]).events[0].kind is EventKind.GOAL


def test_a_penalty_goes_in_directly(rig):
    kick(taken(rig, "penalty"), away=0.6)
    assert shot(rig).events[0].kind is EventKind.GOAL


@pytest.mark.parametrize(("touches", "counts"), [(["cyan2"], False), (["cyan2", "magenta3", "cyan2"], True)])
def test_a_dropped_ball_wants_two_robots_before_a_goal(rig, touches, counts):
    taken(rig, "drop_ball", None)
    for robot in touches:
        rig.tick((3.0, 0.0), [robot])
    assert (shot(rig).events[0].kind is EventKind.GOAL) == counts


def test_in_a_friendly_a_direct_shot_counts_and_no_touch_is_too_early(new_rig):
    rig = taken(new_rig(rules="friendly"))
    rig.tick(SPOT, ["cyan2"])
    rig.tick((SPOT[0] + 0.4, SPOT[1]), ["cyan3"])
    rig.tick((SPOT[0] + 0.6, SPOT[1]), ["cyan2"])
    assert fouls(rig) == [] and rig.state.phase is Phase.PLAY
    assert shot(rig).events[0].kind is EventKind.GOAL


def test_who_stands_wrong_at_the_limit_is_named_carded_and_moved(rig):
    """MSL rule book 2016: too near is a yellow card. simatch's referee does not check it."""
    rig.playing()
    rig.ask("free_kick", CYAN, SPOT)
    rig.robots["magenta2"] = (SPOT[0] + 1.0, SPOT[1])
    rig.robots["magenta3"] = (SPOT[0], SPOT[1] + 2.0)
    stood = dict(rig.robots)
    rig.until(lambda state: state.running)
    near = {"magenta2": 1.0 - rig.hull, "magenta3": 2.0 - rig.hull}
    assert {foul.robot: foul.measured for foul in fouls(rig)} == pytest.approx(near, abs=1e-3)
    assert {foul.limit for foul in fouls(rig)} == {3.0}
    assert {foul.robot: (foul.place.x, foul.place.y) for foul in fouls(rig)} == {name: stood[name] for name in near}
    cards = [(event.robot, event.card) for event in rig.events if event.kind is EventKind.CARD]
    assert sorted(cards) == [("magenta2", Card.YELLOW), ("magenta3", Card.YELLOW)]
    for name in near:
        x, y = rig.robots[name]
        assert ((x - SPOT[0]) ** 2 + (y - SPOT[1]) ** 2) ** 0.5 - rig.hull >= 3.0
        assert abs(x) <= rig.pitch.goal_line and abs(y) <= rig.pitch.touch_line


def test_in_a_friendly_a_robot_with_a_wrong_position_is_only_named(new_rig):
    rig = new_rig(rules="friendly")
    rig.playing()
    rig.ask("free_kick", CYAN, SPOT)
    rig.robots["magenta2"] = (SPOT[0] + 1.0, SPOT[1])
    rig.until(lambda state: state.running)
    assert len(fouls(rig)) == 1 and rig.robots["magenta2"] == (SPOT[0] + 1.0, SPOT[1])
    assert rig.state.participation.cards == {}


def test_effective_playing_time_counts_the_ball_in_play_alone(rig):
    rig.playing()
    before = rig.state.timing
    rig.run(1.0)
    rig.ask("free_kick", CYAN, SPOT)
    in_play = rig.state.timing.effective
    assert in_play - before.effective == pytest.approx(1.02)
    rig.run(4.0)
    after = rig.state.timing
    assert after.effective == in_play and after.clock - before.clock == pytest.approx(5.02)
