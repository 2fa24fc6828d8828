"""Charging: who drove into whom, how fast, whether the ball was played, and what excuses a robot.

Each table holds the least case that breaks the rule and the nearest that does not.
"""

import pytest

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
FAR = (1.0, -5.0)
"""Place of a ball that nobody plays."""


def moving(**robots):
    """Robots that move along x, m/s."""
    return {name: (0.0, speed, 0.0) for name, speed in robots.items()}


def placed(rig, gap=0.5, x=0.0):
    """In play, the ball far away, magenta2 stands so far before cyan3, on the side of larger x."""
    rig.playing(FAR)
    rig.robots |= {"cyan3": (x, 2.0), "magenta2": (x + gap, 2.0)}
    rig.tick(FAR)
    rig.events.clear()
    return rig


def hit(rig, one="cyan3", other="magenta2", ball=None, possession=None, **speeds):
    """One robot hits another at these speeds along x."""
    return rig.tick(ball, impacts=[(one, other)], motions=moving(**speeds), possession=possession)


CALLED = [("charging", "cyan3")]


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize(("speed", "called"), [(1.49, False), (1.51, True), (4.0, True)])
def test_a_robot_that_drives_into_a_standing_opponent_at_speed_charges_it(new_rig, mirrored, speed, called):
    rig = placed(new_rig(mirrored=mirrored))
    hit(rig, cyan3=speed)
    robot = rig.robot("cyan3")
    assert rig.fouls() == ([("charging", robot)] if called else [])
    if called:
        foul = next(event for event in rig.events if event.kind is EventKind.FOUL)
        assert foul.measured == pytest.approx(speed) and (foul.limit, foul.unit) == (1.5, "m/s")
        assert foul.side is rig.side(CYAN) and f"{robot} drove into {rig.robot('magenta2')}" in foul.text
        assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, rig.side(MAGENTA))


@pytest.mark.parametrize(("speed", "card"), [(2.99, None), (3.01, Card.YELLOW)])
def test_a_fast_charge_is_a_yellow_card(new_rig, speed, card):
    rig = placed(new_rig())
    hit(rig, cyan3=speed)
    assert [event.card for event in rig.events if event.kind is EventKind.FOUL] == [card]
    assert [event.robot for event in rig.events if event.kind is EventKind.CARD] == (["cyan3"] if card else [])


@pytest.mark.parametrize(
    ("speeds", "offender"),
    [
        ({"cyan3": 3.0, "magenta2": -2.0}, "cyan3"),
        ({"cyan3": 2.0, "magenta2": -3.0}, "magenta2"),
        ({"cyan3": 2.0, "magenta2": -1.75}, None),
        ({"cyan3": 2.0, "magenta2": -1.65}, "cyan3"),
        ({"cyan3": 3.0, "magenta2": 1.6}, None),
        ({"cyan3": 3.0, "magenta2": 1.4}, "cyan3"),
        ({"cyan3": -1.0, "magenta2": -3.0}, "magenta2"),
    ],
)
def test_the_robot_that_drove_faster_toward_the_other_is_the_offender_and_neither_of_two_equals(
    new_rig, speeds, offender
):
    rig = placed(new_rig())
    hit(rig, **speeds)
    assert rig.fouls() == ([("charging", offender)] if offender else [])


def test_the_speed_of_the_other_robot_makes_no_card(new_rig):
    rig = placed(new_rig())
    hit(rig, cyan3=2.9, magenta2=-2.0)
    assert [event.card for event in rig.events if event.kind is EventKind.FOUL] == [None]


def test_robots_side_by_side_that_touch_do_not_charge(new_rig):
    rig = placed(new_rig())
    rig.tick(impacts=[("cyan3", "magenta2")], motions={"cyan3": (0.0, 1.0, 4.0), "magenta2": (0.0, -0.4, 4.0)})
    assert rig.fouls() == []


def test_teammates_that_hit_each_other_commit_no_foul(new_rig):
    rig = placed(new_rig())
    rig.robots["cyan4"] = (-0.5, 2.0)
    hit(rig, "cyan4", "cyan3", cyan4=4.0)
    assert rig.fouls() == []


def test_a_robot_on_its_own_penalty_area_gives_a_penalty_away(new_rig):
    rig = new_rig()
    placed(rig, x=-rig.pitch.goal_line + 1.5)
    hit(rig, cyan3=2.0)
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.PENALTY, MAGENTA)


def touching_ball(rig, air, behind=False):
    """The ball with so much air before the hull of cyan3, or behind it."""
    way = rig.hull + rig.radius + air
    return (-way if behind else way, 2.0)


@pytest.mark.parametrize(("air", "called"), [(0.29, False), (0.31, True)])
def test_a_robot_that_plays_the_ball_does_not_charge(new_rig, air, called):
    rig = placed(new_rig(), gap=1.0)
    hit(rig, ball=touching_ball(rig, air), cyan3=2.0)
    assert rig.fouls() == (CALLED if called else [])


def test_a_robot_with_the_ball_behind_it_charges_as_any_other(new_rig):
    rig = placed(new_rig(), gap=0.5)
    hit(rig, ball=touching_ball(rig, 0.0, behind=True), possession="cyan3", cyan3=2.0)
    assert rig.fouls() == CALLED


def test_a_ball_that_flies_over_the_robots_is_not_played(new_rig):
    rig = placed(new_rig(), gap=1.0)
    x, y = touching_ball(rig, 0.0)
    hit(rig, ball=(x, y, 1.5), cyan3=2.0)
    assert rig.fouls() == CALLED


def test_a_robot_that_holds_the_ball_is_charged_from_behind(new_rig):
    rig = placed(new_rig())
    hit(rig, ball=(0.5 + rig.hull + rig.radius, 2.0), possession="magenta2", cyan3=2.0)
    assert rig.fouls() == CALLED


@pytest.mark.parametrize("shover", ["magenta3", "magenta2"])
def test_a_robot_that_an_opponent_has_knocked_into_another_is_no_offender(new_rig, shover):
    rig = placed(new_rig(), gap=0.8)
    rig.robots["magenta3"] = (-0.5, 2.0)
    hit(rig, "magenta3", "cyan3", ball=(-0.25, 2.3), magenta3=3.0)
    assert rig.fouls() == []
    rig.run(0.1)
    hit(rig, ball=FAR, cyan3=2.0)
    assert rig.fouls() == []


def test_a_robot_that_a_teammate_has_knocked_into_an_opponent_makes_the_teammate_the_offender(new_rig):
    rig = placed(new_rig(), gap=0.8)
    rig.robots["cyan4"] = (-0.5, 2.0)
    hit(rig, "cyan4", "cyan3", cyan4=3.0)
    rig.run(0.1)
    hit(rig, cyan3=2.0)
    assert rig.fouls() == [("charging", "cyan4")]
    assert "cyan4 drove cyan3 into magenta2" in rig.events[0].text


@pytest.mark.parametrize(("later", "called"), [(0.1, False), (0.7, True), (1.1, True)])
def test_a_bump_of_a_teammate_excuses_no_charge_that_the_robot_had_time_to_drive(new_rig, later, called):
    """The drive gains 2.5 m/s in a second."""
    rig = placed(new_rig(), gap=0.8)
    rig.robots["cyan4"] = (-0.5, 2.0)
    hit(rig, "cyan4", "cyan3", cyan4=0.8)
    rig.run(later)
    hit(rig, cyan3=1.7)
    assert rig.fouls() == (CALLED if called else [])


def test_a_robot_that_was_at_speed_before_a_bump_is_not_excused_by_it(new_rig):
    rig = placed(new_rig(), gap=0.8)
    rig.robots["cyan4"] = (-0.5, 2.0)
    hit(rig, "cyan4", "cyan3", cyan4=3.5, cyan3=2.5)
    hit(rig, cyan3=2.9)
    assert rig.fouls() == CALLED


def test_a_robot_that_an_opponent_pushes_into_another_is_no_offender(new_rig):
    rig = placed(new_rig(), gap=0.6)
    rig.robots["magenta3"] = (-0.5, 2.0)
    push = {"contacts": [("magenta3", "cyan3")], "motions": moving(magenta3=1.8, cyan3=1.8)}
    for _ in range(3):
        rig.tick(**push)
    rig.tick(impacts=[("cyan3", "magenta2")], **push)
    assert rig.fouls() == []


def test_two_charges_in_one_tick_are_one_decision(new_rig):
    rig = placed(new_rig())
    rig.robots |= {"cyan4": (3.0, 2.0), "magenta4": (3.5, 2.0)}
    rig.tick(impacts=[("cyan3", "magenta2"), ("cyan4", "magenta4")], motions=moving(cyan3=3.0, cyan4=3.0))
    assert rig.fouls() == CALLED


def test_charging_is_called_as_the_rule_book_says(new_rig):
    for speed, called in ((2.4, []), (2.6, CALLED)):
        friendly = placed(new_rig(rules="friendly"))
        hit(friendly, cyan3=speed)
        assert friendly.fouls() == called
    china = placed(new_rig(rules="china-sim-2020"))
    hit(china, cyan3=1.6)
    assert [event.card for event in china.events if event.kind is EventKind.FOUL] == [Card.YELLOW]
