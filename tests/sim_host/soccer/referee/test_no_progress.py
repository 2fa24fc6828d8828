"""No progress: what does not end the time of a ball that stays within a circle, and what does."""

import math

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, Phase

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def caught(new_rig, rules="msl", mirrored=False):
    """A robot has caught the ball in the middle of the other half; the robots around it are far away."""
    rig = new_rig("msl", rules, mirrored=mirrored).playing((-5.0, 0.0))
    rig.tick((4.0, 0.0), ["cyan3"], possession="cyan3")
    return rig


def carry(rig, seconds, place):
    """The robot holds the ball at `place(t)`, t in s, and stands behind it."""
    for step in range(round(seconds / rig.dt)):
        x, y = place(step * rig.dt)
        rig.robots["cyan3"] = (x - rig.hull - rig.radius, y)
        rig.tick((x, y), ["cyan3"], possession="cyan3")


def spin(t):
    """On its spot, as far from the robot's axis as the ball is held."""
    return 3.6 + 0.4 * math.cos(3.0 * t), 0.4 * math.sin(3.0 * t)


def circle(radius):
    """To the edge of a circle around the catch, and around it at 2 m/s."""

    def place(t):
        away = min(radius, 2.0 * t)
        return 4.0 + away * math.cos(2.0 * t / radius), away * math.sin(2.0 * t / radius)

    return place


def stalls(rig):
    return [event for event in rig.events if event.rule == "no_progress" and event.kind is EventKind.STALL]


def assert_dropped_after_10_s(rig, began):
    event, *_ = stalls(rig)
    assert event.kind is EventKind.STALL and rig.state.pending.phase is Phase.DROP_BALL
    assert (event.measured, event.limit, event.unit) == (pytest.approx(10.02), 10.0, "s")
    assert event.time - began == pytest.approx(10.02) and "no progress" in event.text


@pytest.mark.parametrize("place", [spin, circle(2.9), circle(1.0)], ids=["spin", "circle of 2.9 m", "circle of 1 m"])
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_robot_that_turns_on_its_spot_or_in_its_circle_with_the_ball_is_stopped(new_rig, place, mirrored):
    rig = caught(new_rig, mirrored=mirrored)
    began = rig.at * rig.dt
    carry(rig, 10.5, place)
    assert_dropped_after_10_s(rig, began)
    assert stalls(rig)[0].robot == rig.robot("cyan3")


def test_a_visible_release_and_another_catch_at_the_same_place_give_no_new_time(new_rig):
    """Every second the ball is 11 cm in front of the hull, released by the rule on dribbling, and caught again."""
    rig = caught(new_rig)
    began = rig.at * rig.dt
    catches = set()
    while not stalls(rig):
        x, y = 4.0, 0.0
        rig.robots["cyan3"] = (x - rig.hull - rig.radius, y)
        rig.tick((x, y), ["cyan3"], possession="cyan3")
        catches.add(rig.state.evidence.dribble and rig.state.evidence.dribble.since)
        for _ in range(48):
            rig.tick((x, y), ["cyan3"], possession="cyan3")
        rig.tick((x + 0.11, y))
    assert len(catches) > 8
    assert_dropped_after_10_s(rig, began)


def test_teammates_that_pass_the_ball_over_40_cm_make_no_progress(new_rig):
    rig = caught(new_rig)
    began = rig.at * rig.dt
    while not stalls(rig):
        for name, x in (("cyan4", 4.4), ("cyan3", 4.0)):
            for _ in range(20):
                rig.tick((x, 0.0), [name], possession=name)
            rig.tick(((4.0 + 4.4) / 2, 0.0))
    assert_dropped_after_10_s(rig, began)


def test_a_ball_that_robots_nudge_about_without_a_catch_makes_no_progress(new_rig):
    """Faster than a ball that lies still, so that it does not stall."""
    rig = new_rig().playing((-5.0, 0.0))
    rig.tick((4.0, 0.0), ["cyan3"])
    began = rig.at * rig.dt
    while not stalls(rig):
        rig.tick((4.0 + 0.3 * math.sin(rig.at * rig.dt), 0.0), ["cyan3"] if rig.at % 10 == 0 else [])
    assert_dropped_after_10_s(rig, began)


def test_the_catch_of_a_loose_ball_gives_new_time_once(new_rig):
    rig = new_rig().playing((-5.0, 0.0))
    rig.tick((4.0, 0.0))
    rig.run(8.0)
    carry(rig, 8.0, lambda t: (4.0, 0.0))
    assert stalls(rig) == []
    rig.tick((4.2, 0.0))
    carry(rig, 2.2, lambda t: (4.0, 0.0))
    assert len(stalls(rig)) == 1


def test_both_sides_that_win_the_ball_from_each_other_in_one_place_make_no_progress(new_rig):
    rig = caught(new_rig)
    began = rig.at * rig.dt
    while not stalls(rig):
        for name in ("magenta2", "cyan3"):
            for _ in range(50):
                rig.tick((4.0, 0.0), [name], possession=name)
    assert_dropped_after_10_s(rig, began)


@pytest.mark.parametrize(("away", "dropped"), [(2.99, True), (3.01, False)])
def test_a_ball_that_leaves_the_circle_makes_progress(new_rig, away, dropped):
    rig = caught(new_rig)
    carry(rig, 9.0, spin)
    rig.tick((4.0 + away, 0.0))
    carry(rig, 2.0, lambda t: (4.0, 0.0))
    assert bool(stalls(rig)) is dropped


def test_a_robot_that_releases_the_ball_on_its_way_out_of_the_circle_has_its_next_circle_around_the_next_catch(new_rig):
    rig = caught(new_rig)
    carry(rig, 1.0, lambda t: (4.0 + 2.5 * t, 0.0))
    rig.tick((6.8, 0.0))
    carry(rig, 1.0, lambda t: (6.8 + t, 0.0))
    progress = rig.state.evidence.progress
    assert progress.place == (6.8, 0.0) and rig.state.phase is Phase.PLAY
    carry(rig, 10.2, lambda t: (6.8 + 2.9 * math.cos(t), 2.9 * math.sin(t)))
    assert len(stalls(rig)) == 1


def test_the_time_begins_when_the_ball_is_in_play(new_rig):
    rig = new_rig().playing()
    rig.ask("free_kick", CYAN, (4.0, 0.0))
    rig.until(lambda state: state.running)
    rig.until(lambda state: state.phase is Phase.PLAY)
    assert rig.state.evidence.progress is None
    rig.run(10.0)
    assert stalls(rig) == []
    rig.run(0.06)
    assert len(stalls(rig)) == 1


def test_a_goalkeeper_that_keeps_the_ball_in_its_area_loses_it_to_a_drop_at_the_nearest_restart_spot(new_rig):
    rig = new_rig().playing((5.0, 0.0))
    x, pitch = -rig.pitch.goal_line + 1.0, rig.pitch
    rig.robots["cyan1"] = (x - 0.35, 1.0)
    for _ in range(520):
        rig.tick((x, 1.0), ["cyan1"], possession="cyan1")
    (event,) = stalls(rig)
    assert (event.robot, event.place.x) == ("cyan1", pytest.approx(x))
    assert rig.state.pending.spot == pytest.approx((-pitch.goal_line + pitch.penalty_mark, 0.0))


def test_the_simulation_league_shows_its_card_for_a_long_hold_before_the_ball_is_dropped(new_rig):
    rig = caught(new_rig, "china-sim-2020")
    carry(rig, 10.5, spin)
    assert stalls(rig) == [] and EventKind.CARD in rig.kinds()
