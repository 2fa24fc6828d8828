"""The evidence: what is kept of touches, passes, catches, kicks and struggles, and that a quiet tick makes nothing."""

import pytest

from schemas.side import Side
from sim_host.referee.evidence import NO_EVIDENCE

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
    ("seen", "control"), [({}, CYAN), ({"kicked": "magenta2"}, MAGENTA), ({"possession": "magenta2"}, MAGENTA)]
)
def test_a_side_wins_the_ball_by_a_hold_or_a_kick_and_not_by_a_touch_in_passing(played, seen, control):
    played.tick((2.0, 1.0), ["cyan3"], kicked="cyan3")
    played.tick((3.0, 1.0), ["magenta2"], **seen)
    play = played.state.evidence.play
    assert play.control is control
    assert play.won == ((3.0, 1.0) if control is MAGENTA else (1.0, 0.0))


@pytest.mark.parametrize(("to", "received"), [(0.99, False), (1.01, True), (-1.5, False)])
def test_a_pass_rolls_freely_from_the_last_touch_and_is_received_in_the_other_half(played, to, received):
    start = 0.5
    played.tick((start, 0.0), ["cyan3"], kicked="cyan3")
    played.tick((start + to, 0.0), ["cyan4"])
    play = played.state.evidence.play
    assert play.received is received and play.rolled == (pytest.approx(abs(to)) if abs(to) > 1.0 else 0.0)


def test_nothing_is_kept_over_a_stop(played):
    played.tick((0.0, 1.0), ["cyan3"], possession="cyan3")
    played.ask("stop")
    played.tick()
    assert played.state.evidence is NO_EVIDENCE and played.state.last_touch is None


def test_a_catch_is_where_and_when_the_hold_began(played):
    played.tick((2.0, 1.0), ["cyan3"], possession="cyan3")
    began = played.at * played.dt
    played.tick((2.5, 1.0), ["cyan3"], possession="cyan3")
    dribble = played.state.evidence.dribble
    assert (dribble.robot, dribble.caught, dribble.since) == ("cyan3", (2.0, 1.0), pytest.approx(began))


@pytest.mark.parametrize(
    ("touches", "ends"), [([], False), (["cyan3"], False), (["magenta4"], True), (["cyan4"], True)]
)
def test_a_dribble_ends_when_another_robot_touches_the_free_ball(played, touches, ends):
    played.robots["cyan3"] = (2.0, 1.0)
    played.tick((2.35, 1.0), ["cyan3"], possession="cyan3")
    played.tick((2.35, 1.0), touches)
    assert (played.state.evidence.dribble is None) is ends


def test_a_kick_releases_the_ball_when_there_is_air_behind_it(played):
    played.robots["cyan3"] = (2.0, 1.0)
    played.tick((2.35, 1.0), ["cyan3"], possession="cyan3")
    played.tick((2.37, 1.0), ["cyan3"], kicked="cyan3")
    assert played.state.evidence.dribble is not None
    played.tick((2.0 + played.hull + played.radius + 0.11, 1.0))
    assert played.state.evidence.dribble is None


@pytest.mark.parametrize(("pause", "ended"), [(0.48, False), (0.52, True)])
def test_a_backward_movement_ends_after_half_a_second_without_backward_motion(played, pause, ended):
    backward = {"motions": {"cyan3": (0.0, -1.0, 0.0)}}
    for _ in range(20):
        played.tick((2.0, 1.0), ["cyan3"], possession="cyan3", **backward)
    for _ in range(round(pause / played.dt)):
        played.tick((2.0, 1.0), ["cyan3"], possession="cyan3")
    played.tick((2.0, 1.0), ["cyan3"], possession="cyan3", **backward)
    assert (played.state.evidence.dribble.backward < 0.1) is ended


def test_a_kick_in_flight_has_its_apex_and_its_landing(played):
    played.robots["cyan3"] = (2.0, 1.0)
    heights = ((2.4, 0.05), (4.0, 0.8), (6.0, 0.4), (7.0, 0.02), (8.0, 0.3), (9.0, 0.0))
    seen = []
    for tick, (x, air) in enumerate(heights):
        kick = {"touches": ["cyan3"], "kicked": "cyan3"} if tick == 0 else {}
        played.tick((x, 1.0, played.radius + air), **kick)
        seen.append(played.state.evidence.flight)
    assert seen[-1].apex == pytest.approx(0.8) and seen[-1].landed == (7.0, 1.0)
    assert [flight.just_landed for flight in seen] == [False, False, False, True, False, False]
    assert seen[0].kicked_from == (2.0, 1.0)


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


def test_a_quiet_tick_keeps_the_same_evidence(played):
    before = played.state.evidence
    played.tick((1.5, 0.0))
    assert played.state.evidence is before
