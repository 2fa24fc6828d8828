"""Each rule: the least case that breaks it, and the nearest that does not."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def beyond(rig, axis, by):
    """A coordinate `by` m beyond the place where the whole ball has passed the line."""
    line = rig.pitch.goal_line if axis == "x" else rig.pitch.touch_line
    return line + rig.radius + by


@pytest.mark.parametrize(("end", "scorers", "toucher"), [(1, CYAN, "cyan3"), (-1, MAGENTA, "magenta4")])
def test_a_ball_wholly_over_the_goal_line_in_the_goal_counts_and_the_other_side_kicks_off(rig, end, scorers, toucher):
    ruling = rig.crossing((end * (rig.pitch.goal_line - 0.1), 0.5), (end * beyond(rig, "x", 0.01), 0.5), [toucher])
    goal, stop = ruling.events
    assert (goal.kind, goal.rule, goal.side, goal.robot) == (EventKind.GOAL, "goal", scorers, toucher)
    assert goal.score == Score(**{scorers.value: 1}) == ruling.state.score
    assert goal.place.x == pytest.approx(end * beyond(rig, "x", 0.0)) and goal.place.y == pytest.approx(0.5)
    assert stop.kind is EventKind.STOP and ruling.state.phase is Phase.STOPPED and not ruling.state.running
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    assert rig.state.side is scorers.opponent and rig.state.spot == (0.0, 0.0)


def test_a_ball_not_wholly_over_the_goal_line_is_no_goal(rig):
    ruling = rig.crossing((rig.pitch.goal_line - 0.1, 0.5), (beyond(rig, "x", -0.001), 0.5))
    assert ruling.events == () and ruling.state.phase is Phase.PLAY


def test_an_own_goal_counts_for_the_other_side_and_is_called_so(rig):
    rig.playing()
    rig.tick((rig.pitch.goal_line - 0.1, 0.0), ["magenta1"], possession="magenta1")
    ruling = rig.tick((beyond(rig, "x", 0.01), 0.0))
    assert ruling.state.score == Score(cyan=1)
    assert ruling.events[0].robot == "magenta1" and "own goal" in ruling.events[0].text


def test_a_shot_that_a_defender_deflects_is_the_kickers_goal(rig):
    rig.playing()
    rig.tick((5.0, 0.0), ["cyan3"], kicked="cyan3")
    rig.tick((rig.pitch.goal_line - 0.1, 0.0), ["magenta1"])
    ruling = rig.tick((beyond(rig, "x", 0.01), 0.0))
    assert ruling.events[0].robot == "cyan3" and "own goal" not in ruling.events[0].text


@pytest.mark.parametrize(
    ("aside", "over", "scored"), [(-0.01, -0.01, True), (0.01, -0.01, False), (-0.01, 0.01, False)]
)
def test_a_goal_passes_between_the_posts_and_under_the_bar(rig, aside, over, scored):
    y, z = rig.pitch.goal_width / 2 + aside, rig.pitch.goal_height + over
    ruling = rig.crossing((rig.pitch.goal_line - 0.1, y, z), (beyond(rig, "x", 0.1), y, z))
    assert ruling.events[0].kind is (EventKind.GOAL if scored else EventKind.BALL_OUT)


def test_the_way_of_a_fast_ball_decides_whether_it_passed_between_the_posts(rig):
    line, half = beyond(rig, "x", 0.0), rig.pitch.goal_width / 2
    ruling = rig.crossing((line - 0.1, half - 0.05), (line + 0.1, half + 0.04))
    assert ruling.events[0].kind is EventKind.GOAL
    assert ruling.events[0].place.y == pytest.approx(half - 0.005)


def test_no_goal_is_scored_before_start(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    ruling = rig.tick((beyond(rig, "x", 0.1), 0.0), ["cyan2"])
    assert ruling.state.score == Score() and ruling.events == ()


@pytest.mark.parametrize(("sign", "toucher", "taker"), [(1, "cyan3", MAGENTA), (-1, "magenta2", CYAN)])
def test_a_ball_over_the_touch_line_gives_a_throw_in_to_the_other_side(rig, sign, toucher, taker):
    touch = rig.pitch.touch_line
    ruling = rig.crossing((1.0, sign * (touch - 0.1)), (2.0, sign * (touch + 0.9)), [toucher])
    out = ruling.events[0]
    crossed = 1.0 + (0.1 + rig.radius)
    assert (out.kind, out.rule, out.robot) == (EventKind.BALL_OUT, "touch_line", toucher)
    assert out.place.x == pytest.approx(crossed) and toucher in out.text and "touch line" in out.text
    assert ruling.state.pending.phase is Phase.THROW_IN and ruling.state.pending.side is taker
    inset = rig.book.restarts.touch_line_inset
    assert ruling.state.pending.spot == pytest.approx((crossed, sign * (touch - inset)))


def test_a_ball_on_the_touch_line_is_in(rig):
    ruling = rig.crossing((1.0, 0.0), (1.0, beyond(rig, "y", -0.001)))
    assert ruling.events == () and ruling.state.running


def test_a_ball_past_both_lines_is_judged_by_the_one_it_passed_first(rig):
    x, y = beyond(rig, "x", 0.0), beyond(rig, "y", 0.0)
    ruling = rig.crossing((x - 0.1, y - 0.05), (x + 0.1, y + 0.15), ["cyan2"])
    assert ruling.events[0].rule == "touch_line"
    spot = ruling.state.pending.spot
    assert abs(spot[0]) <= rig.pitch.goal_line and abs(spot[1]) <= rig.pitch.touch_line


@pytest.mark.parametrize(
    ("end", "toucher", "phase", "taker"),
    [
        (1, "magenta2", Phase.CORNER, CYAN),
        (-1, "cyan2", Phase.CORNER, MAGENTA),
        (1, "cyan2", Phase.GOAL_KICK, MAGENTA),
        (-1, "magenta2", Phase.GOAL_KICK, CYAN),
    ],
)
def test_over_the_goal_line_a_defenders_touch_gives_a_corner_and_an_attackers_a_goal_kick(
    rig, end, toucher, phase, taker
):
    ruling = rig.crossing((end * (rig.pitch.goal_line - 0.1), -3.0), (end * beyond(rig, "x", 0.2), -3.0), [toucher])
    assert ruling.events[0].rule == "goal_line" and ruling.events[0].robot == toucher
    assert (ruling.state.pending.phase, ruling.state.pending.side) == (phase, taker)
    inset = rig.book.restarts.corner_inset
    corner = (end * (rig.pitch.goal_line - inset), -(rig.pitch.touch_line - inset))
    marker = (end * (rig.pitch.goal_line - rig.pitch.penalty_mark), -rig.pitch.touch_line / 2)
    assert ruling.state.pending.spot == pytest.approx(corner if phase is Phase.CORNER else marker)


def test_the_last_of_several_touches_in_one_tick_counts(rig):
    rig.playing((1.0, 0.0), ["cyan2"])
    rig.tick((1.0, rig.pitch.touch_line), ["cyan2", "magenta3"])
    ruling = rig.tick((1.0, beyond(rig, "y", 0.1)))
    assert ruling.events[0].robot == "magenta3" and ruling.state.pending.side is CYAN


@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_ball_out_without_a_touch_is_dropped_inside_the_field(rig, axis):
    place = (beyond(rig, "x", 0.1), 4.0) if axis == "x" else (1.0, beyond(rig, "y", 0.1))
    ruling = rig.crossing((1.0, 4.0), place, [])
    assert ruling.events[0].robot is None and "no robot" in ruling.events[0].text
    pending, inset = ruling.state.pending, rig.book.restarts.field_inset
    assert pending.phase is Phase.DROP_BALL and pending.side is None
    assert abs(pending.spot[0]) <= rig.pitch.goal_line - inset
    assert abs(pending.spot[1]) <= rig.pitch.touch_line - inset


def test_touches_before_start_are_forgotten(rig):
    rig.until(lambda state: state.phase is Phase.KICK_OFF)
    rig.tick(touches=["magenta2"])
    rig.until(lambda state: state.running)
    assert rig.state.last_touch is None


def test_a_ball_under_the_ground_is_lost_and_dropped(rig):
    ruling = rig.crossing((2.0, 1.0), (2.0, 1.0, -rig.radius - 0.01))
    assert (ruling.events[0].kind, ruling.events[0].rule) == (EventKind.BALL_OUT, "lost_ball")
    assert ruling.state.pending.phase is Phase.DROP_BALL and ruling.state.pending.spot == (2.0, 1.0)


def test_a_ball_pressed_a_little_into_the_ground_is_not_lost(rig):
    assert rig.crossing((2.0, 1.0), (2.0, 1.0, -rig.radius + 0.01)).events == ()


def test_a_ball_outside_that_crossed_no_line_is_lost_and_dropped_at_the_nearest_legal_place(rig):
    rig.until(lambda state: state.running)
    out = beyond(rig, "y", 0.5)
    rig.state = rig.state._replace(ball=(3.0, out, rig.radius))
    ruling = rig.tick((3.0, out))
    assert ruling.events[0].rule == "lost_ball"
    assert ruling.state.pending.spot == pytest.approx((3.0, rig.pitch.touch_line - rig.book.restarts.field_inset))


def test_a_ball_that_does_not_move_for_long_is_dropped_where_it_lies(rig):
    rig.playing((3.0, 1.0))
    rig.velocity = (rig.book.stall.still_speed * 0.9, 0.0, 0.0)
    rig.run(rig.book.stall.still_duration - 0.04)
    assert rig.state.phase is Phase.PLAY
    rig.run(0.04)
    assert rig.events[-2].kind is EventKind.STALL and rig.events[-2].rule == "stall"
    assert rig.state.pending.phase is Phase.DROP_BALL and rig.state.pending.spot == (3.0, 1.0)


def test_a_stall_names_the_robot_that_holds_the_ball(rig):
    rig.playing((3.0, 1.0))
    rig.velocity = (0.0, 0.0, 0.0)
    for _ in range(round(rig.book.stall.still_duration / rig.dt) + 2):
        rig.tick(possession="cyan2")
    assert [event.robot for event in rig.events if event.kind is EventKind.STALL] == ["cyan2"]


def test_a_ball_that_moves_in_between_is_not_stalled(rig):
    rig.playing((3.0, 1.0))
    rig.velocity = (0.0, 0.0, 0.0)
    rig.run(rig.book.stall.still_duration - 0.1)
    rig.velocity = (rig.book.stall.still_speed * 1.1, 0.0, 0.0)
    rig.tick()
    rig.velocity = (0.0, 0.0, 0.0)
    rig.run(rig.book.stall.still_duration - 0.1)
    assert "stall" not in [event.rule for event in rig.events]


@pytest.mark.parametrize("end", [1, -1])
def test_a_ball_stalled_in_a_penalty_area_is_dropped_at_the_nearest_restart_spot(rig, end):
    rig.playing((end * (rig.pitch.goal_line - 1.0), 2.5))
    rig.velocity = (0.0, 0.0, 0.0)
    rig.run(rig.book.stall.still_duration)
    expected = (end * (rig.pitch.goal_line - rig.pitch.penalty_mark), rig.pitch.touch_line / 2)
    assert rig.state.pending.spot == pytest.approx(expected)


LEVEL = ("cyan2", "magenta3")


@pytest.mark.parametrize("order", [LEVEL, LEVEL[::-1]])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_ball_that_both_sides_touched_last_at_the_same_time_is_dropped_whatever_their_order(rig, axis, order):
    far = (beyond(rig, "x", 0.01), 4.0) if axis == "x" else (3.0, beyond(rig, "y", 0.01))
    rig.playing()
    rig.tick((far[0] - 0.2 * (axis == "x"), far[1] - 0.2 * (axis == "y")), order, level=order)
    out = rig.tick(far).events[0]
    assert (out.kind, out.side, out.robot, out.robots) == (EventKind.BALL_OUT, None, None, list(order))
    assert "at the same time" in out.text
    rig.until(lambda state: state.phase not in (Phase.PLAY, Phase.STOPPED))
    assert rig.state.phase is Phase.DROP_BALL and rig.state.side is None


def test_a_touch_after_a_level_one_is_the_last(rig):
    rig.playing()
    rig.tick((3.0, beyond(rig, "y", -0.4)), LEVEL, level=LEVEL)
    rig.tick((3.0, beyond(rig, "y", -0.2)), ["cyan2"])
    out = rig.tick((3.0, beyond(rig, "y", 0.01))).events[0]
    assert (out.side, out.robot) == (CYAN, "cyan2")
    rig.until(lambda state: state.phase not in (Phase.PLAY, Phase.STOPPED))
    assert (rig.state.phase, rig.state.side) == (Phase.THROW_IN, MAGENTA)


def test_level_touches_of_two_mates_are_touches_of_their_side(rig):
    rig.playing()
    mates = ("magenta3", "magenta4")
    rig.tick((3.0, beyond(rig, "y", -0.2)), mates, level=mates)
    out = rig.tick((3.0, beyond(rig, "y", 0.01))).events[0]
    assert (out.side, out.robot) == (MAGENTA, "magenta4")
