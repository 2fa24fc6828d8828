"""The evidence: what is kept of touches, passes, catches, kicks and struggles, and that a quiet tick makes nothing."""

import pytest

from schemas.side import Side

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


@pytest.fixture
def played(new_rig):
    """A rig of the league in play, with no robot near the ball."""
    return new_rig().playing((1.0, 0.0))


def test_the_last_touch_and_the_other_robot_before_it_are_kept(played):
    for robot in ("cyan3", "magenta2", "magenta2"):
        played.tick((0.0, 1.0), [robot])
    play = played.state.evidence.play
    assert (play.last.robot, play.before, played.state.last_touch) == ("magenta2", "cyan3", "magenta2")
    assert play.last.place == (0.0, 1.0) and play.last.time == pytest.approx(played.at * played.dt)
    assert play.robots[-2:] == ("cyan3", "magenta2") and play.of(CYAN).robot == "cyan3"


@pytest.mark.parametrize(
    ("touches", "ends"), [([], False), (["cyan3"], False), (["magenta4"], True), (["cyan4"], True)]
)
def test_a_dribble_ends_when_another_robot_touches_the_free_ball(played, touches, ends):
    played.robots["cyan3"] = (2.0, 1.0)
    played.tick((2.35, 1.0), ["cyan3"], possession="cyan3")
    played.tick((2.35, 1.0), touches)
    assert (played.state.evidence.dribble is None) is ends


@pytest.mark.parametrize(("pause", "ended"), [(0.48, False), (0.52, True)])
def test_a_backward_movement_ends_after_half_a_second_without_backward_motion(played, pause, ended):
    backward = {"motions": {"cyan3": (0.0, -1.0, 0.0)}}
    for _ in range(20):
        played.tick((2.0, 1.0), ["cyan3"], possession="cyan3", **backward)
    for _ in range(round(pause / played.dt)):
        played.tick((2.0, 1.0), ["cyan3"], possession="cyan3")
    played.tick((2.0, 1.0), ["cyan3"], possession="cyan3", **backward)
    assert (played.state.evidence.dribble.backward < 0.1) is ended


def test_robots_of_one_side_do_not_push_each_other(played):
    played.tick(contacts=[("cyan3", "cyan4")])
    assert played.state.evidence.pushes == ()


def test_a_push_counts_the_distance_that_both_move_and_turns_with_the_pushing_robot(played):
    played.robots |= {"cyan3": (0.0, 2.0), "magenta2": (0.5, 2.0)}
    pair = [("cyan3", "magenta2")]
    played.tick(motions={"cyan3": (0.0, 1.0, 0.0), "magenta2": (0.0, 0.6, 0.0)}, contacts=pair)
    assert played.state.evidence.pushes[0].way == pytest.approx(0.6 * played.dt)
    played.tick(motions={"cyan3": (0.0, 1.0, 0.0), "magenta2": (0.0, -0.6, 0.0)}, contacts=pair)
    assert played.state.evidence.pushes[0].way == pytest.approx(0.6 * played.dt)
    played.tick(motions={"cyan3": (0.0, -1.0, 0.0), "magenta2": (0.0, -1.0, 0.0)}, contacts=pair)
    assert played.state.evidence.pushes[0].way == pytest.approx(-0.4 * played.dt)


@pytest.mark.parametrize(("gap", "parted"), [(0.16, False), (0.22, True)])
def test_two_that_lean_have_parted_after_a_fifth_of_a_second_without_contact(played, gap, parted):
    pair = [("cyan3", "magenta2")]
    for _ in range(10):
        played.tick(contacts=pair)
    played.run(gap)
    played.tick(contacts=pair)
    (push,) = played.state.evidence.pushes
    assert (push.lasted < 0.1) is parted


@pytest.mark.parametrize(("air", "contested"), [(0.09, True), (0.11, False)])
def test_a_ball_is_contested_by_robots_of_both_sides_within_reach(played, air, contested):
    away = played.hull + played.radius
    played.robots |= {"cyan3": (-away, 1.0), "magenta2": (away + air, 1.0)}
    played.tick((0.0, 1.0))
    assert (played.state.evidence.contest is not None) is contested


@pytest.mark.parametrize(("gap", "goes_on"), [(0.46, True), (0.54, False)])
def test_a_contest_goes_on_when_one_side_was_away_for_up_to_half_a_second(played, gap, goes_on):
    away = played.hull + played.radius
    played.robots |= {"cyan3": (-away, 1.0), "magenta2": (away, 1.0)}
    played.ball = (0.0, 1.0, played.radius)
    played.run(1.0)
    played.robots["magenta2"] = (away + 1.0, 1.0)
    played.run(gap)
    played.robots["magenta2"] = (away, 1.0)
    played.run(0.1)
    assert (played.state.evidence.contest.lasted > 1.0) is goes_on


def test_teammates_alone_do_not_contest_the_ball(played):
    played.robots |= {"cyan3": (-0.36, 1.0), "cyan4": (0.36, 1.0)}
    played.tick((0.0, 1.0))
    assert played.state.evidence.contest is None
