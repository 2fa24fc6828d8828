"""Each foul: the least case that breaks the rule, the nearest that does not, and the same with the colours swapped."""

from collections.abc import Callable
from typing import NamedTuple

import pytest

from schemas.config.soccer.rule_book import SHIPPED
from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
NOT_AT_ALL = (0.0, 1e-9)
"""rad/s."""


def hold(rig, robot, seconds, place=None, **seen):
    """A robot holds the ball for a while."""
    for _ in range(round(seconds / rig.dt)):
        rig.tick(place, [robot], possession=robot, **seen)


def dribble_away(rig, way):
    rig.tick((-1.0, 2.0), ["cyan3"], possession="cyan3")
    for share in (0.3, 0.7, 1.0):
        rig.tick((-1.0 + share * way, 2.0), ["cyan3"], possession="cyan3")


def dribble_far_with_a_release(rig, air):
    """Twice 2 m, the ball out of the hold in between, with so much air before the hull."""
    for x in (-2.0, 0.0):
        rig.tick((x, 2.0), ["cyan3"], possession="cyan3")
    rig.robots["cyan3"] = (0.0, 2.0)
    rig.tick((rig.hull + rig.radius + air, 2.0))
    for x in (0.4, 1.8):
        rig.tick((x, 2.0), ["cyan3"], possession="cyan3")


def drive_backward(rig, way):
    rig.tick((0.0, 2.0), ["cyan3"], possession="cyan3")
    hold(rig, "cyan3", way, motions={"cyan3": (0.0, -1.0, 0.0)})


def drive_backward_again(rig, way):
    drive_backward(rig, 1.1)
    hold(rig, "cyan3", 0.6)
    hold(rig, "cyan3", way, motions={"cyan3": (0.0, -1.0, 0.0)})


def drive_backward_in_two_goes(rig, first):
    drive_backward(rig, first)
    hold(rig, "cyan3", 0.6)
    hold(rig, "cyan3", 0.9, motions={"cyan3": (0.0, -1.0, 0.0)})


def drag_without_roll(rig, way):
    rig.velocity = (1.0, 0.0, 0.0)
    hold(rig, "cyan3", way + rig.dt, (0.0, 2.0), spin=NOT_AT_ALL)


def drag_slowly(rig, seconds):
    rig.velocity = (0.2, 0.0, 0.0)
    hold(rig, "cyan3", seconds + rig.dt, (0.0, 2.0), spin=NOT_AT_ALL)


def drag_turning(rig, share):
    """2 m, with a ball that turns at so much of its natural rate."""
    rig.velocity = (1.0, 0.0, 0.0)
    hold(rig, "cyan3", 2.0, (0.0, 2.0), spin=(0.0, share / rig.radius))


def keep_long(rig, seconds):
    rig.tick((0.0, 2.0), ["cyan3"], possession="cyan3")
    hold(rig, "cyan3", seconds)


def stand_in_goal_area(name, end, depth=0.3):
    def story(rig, seconds):
        rig.robots[name] = (end * (rig.pitch.goal_line - depth), 0.5)
        rig.run(seconds)

    return story


def stand_before_goal_area(rig, margin):
    rig.robots["cyan3"] = (rig.pitch.goal_line - rig.pitch.goal_area_depth - margin, 0.5)
    rig.run(0.6)


def crowd(end, names):
    def story(rig, seconds):
        for place, name in enumerate(names):
            rig.robots[name] = (end * (rig.pitch.goal_line - 1.5), 0.8 * place)
        rig.play_on(seconds)

    return story


def push(rig, way, x=0.0):
    rig.robots |= {"cyan3": (x, 2.0), "magenta2": (x + 0.5, 2.0)}
    moving = {"cyan3": (0.0, 1.0, 0.0), "magenta2": (0.0, 1.0, 0.0)}
    for _ in range(round(way / rig.dt)):
        rig.tick(motions=moving, contacts=[("cyan3", "magenta2")])


def push_in_own_area(rig, way):
    push(rig, way, -rig.pitch.goal_line + 1.5)


def lean(rig, seconds):
    rig.robots |= {"cyan3": (0.0, 2.0), "magenta2": (0.5, 2.0)}
    against = {"cyan3": (0.0, 0.2, 0.0), "magenta2": (0.0, -0.2, 0.0)}
    rig.play_on(seconds, motions=against, contacts=[("cyan3", "magenta2")])


def contest(rig, seconds):
    rig.robots |= {"cyan3": (4.6, 1.0), "magenta2": (5.4, 1.0)}
    rig.tick((5.0, 1.0))
    rig.run(seconds)


def contest_on_the_way(rig, way):
    """10 s, the ball moved once by so much in the middle."""
    contest(rig, 6.0)
    rig.robots |= {"cyan3": (4.6 + way, 1.0), "magenta2": (5.4 + way, 1.0)}
    rig.tick((5.0 + way, 1.0))
    rig.run(4.0)


def lob(rig, apex, kick_from=-2.0, mate_at=None):
    rig.robots["cyan3"] = (kick_from, 1.0)
    if mate_at is not None:
        rig.robots["cyan4"] = mate_at
    rig.tick((kick_from + 0.4, 1.0, rig.radius + 0.02), ["cyan3"], kicked="cyan3")
    rig.tick((1.0, 1.0, rig.radius + apex))
    rig.tick((4.0, 1.0, rig.radius + 0.01))


def lob_from(rig, x):
    lob(rig, 0.9, kick_from=x)


def lob_to_mate(rig, away):
    lob(rig, 0.9, mate_at=(4.0, 1.0 - away))


def goal_after(*touches):
    """A goal of cyan's after these touches: (robot, x)."""

    def story(rig, _amount):
        for robot, x in touches:
            rig.tick((x, 0.5), [robot], kicked=robot)
        rig.tick((rig.pitch.goal_line - 0.1, 0.5))
        rig.tick((rig.pitch.goal_line + 0.2, 0.5))

    return story


def shoot_from(rig, x):
    rig.tick((1.0, 0.5), ["magenta2"], kicked="magenta2")
    rig.tick((1.0, 0.5), ["cyan3"], possession="cyan3")
    rig.tick((x, 0.5), ["cyan3"], kicked="cyan3")
    rig.tick((rig.pitch.goal_line - 0.1, 0.5))
    rig.tick((rig.pitch.goal_line + 0.2, 0.5))


def score_after_a_pass_of(rig, roll):
    """Won in the own half by cyan, passed in the other half."""
    rig.tick((-2.0, 0.5), ["magenta2"], kicked="magenta2")
    rig.tick((-2.0, 0.5), ["cyan3"], kicked="cyan3")
    rig.tick((3.0, 0.5), ["cyan3"], kicked="cyan3")
    rig.tick((3.0 + roll, 0.5), ["cyan4"], kicked="cyan4")
    rig.tick((rig.pitch.goal_line - 0.1, 0.5))
    rig.tick((rig.pitch.goal_line + 0.2, 0.5))


def stay_outside(rig, seconds):
    rig.robots["cyan3"] = (1.0, rig.pitch.touch_line + rig.hull + 0.01)
    rig.play_on(seconds)


class Case(NamedTuple):
    rule: str
    story: Callable
    breaks: float
    allowed: float
    restart: Phase = Phase.FREE_KICK
    offenders: tuple = ("cyan3",)
    rules: str = "msl"
    card: Card | None = None
    taker: Side | None = MAGENTA
    kind: EventKind = EventKind.FOUL


KEEPER, BOTH = ("cyan1",), ("cyan3", "magenta2")
CASES = {
    "dribble out of the circle": Case("dribble_circle", dribble_away, 3.01, 2.99),
    "circle moves at a visible release alone": Case("dribble_circle", dribble_far_with_a_release, 0.09, 0.11),
    "backward": Case("backward", drive_backward, 2.04, 1.98),
    "backward again": Case("backward", drive_backward_again, 0.12, 0.08),
    "backward twice": Case("backward", drive_backward_in_two_goes, 1.02, 0.98),
    "way without turning": Case("not_rolling", drag_without_roll, 0.32, 0.28),
    "time without turning": Case("not_rolling", drag_slowly, 1.04, 0.96),
    "turning too slowly": Case("not_rolling", drag_turning, 0.49, 0.51),
    "long hold": Case("long_hold", keep_long, 10.04, 9.96, rules="china-sim-2020", card=Card.YELLOW),
    "illegal defence, goal area": Case("goal_area", stand_in_goal_area("cyan3", -1), 0.54, 0.46),
    "illegal attack, goal area": Case("goal_area", stand_in_goal_area("cyan3", 1), 0.54, 0.46),
    "goalkeeper in the other area": Case("goal_area", stand_in_goal_area("cyan1", 1), 0.54, 0.46, offenders=KEEPER),
    "in the goal itself": Case("goal_area", stand_in_goal_area("cyan3", 1, -0.1), 0.54, 0.46),
    "at the goal area's line": Case("goal_area", stand_before_goal_area, -0.01, 0.01),
    "at once in china": Case(
        "goal_area", stand_in_goal_area("cyan3", 1), 0.02, 0.0, rules="china-sim-2020"
    ),
    "illegal attack, penalty area": Case(
        "penalty_area", crowd(1, ("cyan3", "cyan4")), 0.02, 0.0, offenders=("cyan4", "cyan3")
    ),
    "illegal defence, penalty area": Case(
        "penalty_area", crowd(-1, ("cyan1", "cyan3", "cyan4")), 0.02, 0.0, offenders=("cyan4", "cyan3")
    ),
    "one attacker waits in the penalty area": Case("penalty_area", crowd(1, ("cyan3",)), 10.04, 9.96),
    "one defender waits in the penalty area": Case("penalty_area", crowd(-1, ("cyan1", "cyan3")), 10.04, 9.96),
    "the goalkeeper waits in the other penalty area": Case(
        "penalty_area", crowd(1, ("cyan1",)), 10.04, 9.96, offenders=KEEPER
    ),
    "penalty area at once in china": Case(
        "penalty_area", crowd(1, ("cyan3", "cyan4")), 0.02, 0.0, offenders=("cyan4", "cyan3"), rules="china-sim-2020"
    ),
    "pushing": Case("pushing", push, 0.54, 0.48),
    "pushing in china": Case("pushing", push, 0.54, 0.48, rules="china-sim-2020", card=Card.YELLOW),
    "pushing in the own area": Case("pushing", push_in_own_area, 0.54, 0.48, Phase.PENALTY),
    "stand-off": Case(
        "stand_off", lean, 10.02, 9.96, Phase.DROP_BALL, BOTH, taker=None, kind=EventKind.STALL
    ),
    "scrum": Case("scrum", contest, 10.02, 9.96, Phase.DROP_BALL, BOTH, taker=None, kind=EventKind.STALL),
    "scrum without enough progress": Case(
        "scrum", contest_on_the_way, 0.49, 0.51, Phase.DROP_BALL, BOTH, taker=None, kind=EventKind.STALL
    ),
    "lob": Case("lob", lob, 0.61, 0.59),
    "lob from the own half": Case("lob", lob_from, -0.01, 0.01),
    "lob to a teammate": Case("lob", lob_to_mate, 3.01, 2.99),
    "goal from the own half": Case(
        "own_half_goal", shoot_from, -0.12, -0.10, Phase.GOAL_KICK, kind=EventKind.NO_GOAL
    ),
    "goal without a pass": Case(
        "own_half_goal", score_after_a_pass_of, 0.99, 1.01, Phase.GOAL_KICK, ("cyan4",), kind=EventKind.NO_GOAL
    ),
    "outside the field": Case("leaving_field", stay_outside, 10.04, 9.96),
}  # fmt: skip


def told(new_rig, case, amount, mirrored=False):
    """The rig after the story, and the first event of the case's rule."""
    rig = new_rig("msl", case.rules, mirrored=mirrored).playing((1.0, 0.0))
    case.story(rig, amount)
    return rig, next((event for event in rig.events if event.rule == case.rule), None)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_least_case_is_called_with_its_measure_and_the_nearest_other_is_not(new_rig, case):
    rig, event = told(new_rig, case, case.breaks)
    assert event is not None and event.kind is case.kind
    assert event.measured is not None and event.unit in ("m", "s")
    assert f"{event.limit:.1f}" in event.text and event.place is not None
    assert (tuple(event.robots) or (event.robot,)) == case.offenders
    assert all(name in event.text for name in case.offenders) or case.rule == "scrum"
    assert event.card is case.card
    assert (rig.state.pending.phase, rig.state.pending.side) == (case.restart, case.taker)
    (x, y), pitch = rig.state.pending.spot, rig.pitch
    assert abs(x) <= pitch.goal_line - pitch.penalty_area_depth or abs(y) >= pitch.penalty_area_width / 2
    assert abs(y) <= pitch.touch_line
    _, nothing = told(new_rig, case, case.allowed)
    assert nothing is None


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_colours_swapped_the_same_is_decided(new_rig, case):
    rig, event = told(new_rig, case, case.breaks)
    turned, mirror = told(new_rig, case, case.breaks, mirrored=True)
    assert mirror is not None and (mirror.tick, mirror.measured) == (event.tick, pytest.approx(event.measured))
    assert (-mirror.place.x, -mirror.place.y) == pytest.approx((event.place.x, event.place.y))
    assert mirror.robot == (event.robot and turned.robot(event.robot))
    assert sorted(mirror.robots) == sorted(turned.robot(name) for name in event.robots)
    spot, other = rig.state.pending.spot, turned.state.pending.spot
    assert (-other[0], -other[1]) == pytest.approx(spot)


@pytest.mark.parametrize("rule", ["own_half_goal", "dribble_circle", "backward", "not_rolling", "lob", "leaving_field"])
def test_a_friendly_forgives(new_rig, rule):
    for case in CASES.values():
        if case.rule == rule:
            _, event = told(new_rig, case._replace(rules="friendly"), case.breaks)
            assert event is None


def test_the_goalkeeper_may_be_in_its_goal_area_and_beside_one_other_in_its_penalty_area(new_rig):
    rig = new_rig().playing()
    rig.robots |= {"cyan1": (-rig.pitch.goal_line + 0.3, 0.0), "cyan3": (-rig.pitch.goal_line + 1.5, 1.0)}
    rig.play_on(9.0)
    assert EventKind.FOUL not in rig.kinds()


@pytest.mark.parametrize("deed", ["repair", "red_card"])
def test_while_the_goalkeeper_is_off_the_field_the_first_robot_on_it_keeps_the_goal_and_no_other(new_rig, deed):
    rig = new_rig().playing()
    rig.ask(deed, robot="cyan1")
    rig.robots["cyan2"] = (-rig.pitch.goal_line + 0.3, 0.5)
    rig.run(3.0)
    assert EventKind.FOUL not in rig.kinds()
    rig.robots |= {"cyan3": (-rig.pitch.goal_line + 0.3, -0.7)}
    rig.run(3.0)
    assert [event.robot for event in rig.events if event.kind is EventKind.FOUL] == ["cyan3"]


def test_when_the_goalkeeper_is_back_its_substitute_leaves_the_goal_area(new_rig):
    rig = new_rig().playing()
    rig.ask("repair", robot="cyan1")
    rig.run(rig.book.people.repair)
    rig.ask("stop")
    rig.until(lambda state: "cyan1" not in state.participation.absences)
    rig.ask("free_kick", Side.MAGENTA, (4.0, 0.0))
    rig.robots["cyan2"] = (-rig.pitch.goal_line + 0.3, 0.5)
    rig.until(lambda state: state.running)
    rig.run(3.0)
    assert [event.robot for event in rig.events if event.kind is EventKind.FOUL] == ["cyan2"]


@pytest.mark.parametrize("behind", [0.6, 5.0])
def test_behind_the_goal_line_and_outside_the_goal_no_robot_is_in_an_area(new_rig, behind):
    """simatch's referee has no limit along x."""
    rig = new_rig().playing()
    rig.robots["cyan3"] = (rig.pitch.goal_line + behind, 0.5)
    rig.run(3.0)
    assert EventKind.FOUL not in rig.kinds()


def fouls(rig):
    return [event.robot for event in rig.events if event.kind is EventKind.FOUL]


@pytest.mark.parametrize(("from_behind", "called"), [(True, []), (False, ["cyan3"])])
def test_a_robot_that_an_opponent_pushes_into_its_goal_area_is_not_called_for_it(new_rig, from_behind, called):
    rig = new_rig().playing()
    inside = -rig.pitch.goal_line + 0.5
    rig.robots |= {"cyan3": (inside, 0.5), "magenta2": (inside + (0.5 if from_behind else -0.5), 0.5)}
    for _ in range(round(0.6 / rig.dt)):
        rig.tick(contacts=[("cyan3", "magenta2")])
    assert fouls(rig) == called
    rig.run(0.6)
    assert fouls(rig) == ["cyan3"]  # nobody holds it there


def test_robots_that_an_opponent_has_hit_are_not_too_many_in_a_penalty_area_for_a_moment(new_rig):
    rig = new_rig(rules="msl").playing()
    inside = -rig.pitch.goal_line + 1.5
    rig.robots |= {"cyan3": (inside, 1.0), "cyan4": (inside, -1.0), "magenta2": (inside + 0.5, -1.0)}
    rig.tick(motions={"magenta2": (0.0, -1.0, 0.0)}, impacts=[("cyan4", "magenta2")])
    rig.run(0.4)
    assert fouls(rig) == []
    rig.run(0.6)
    assert fouls(rig) == ["cyan4"]


def test_two_robots_may_take_turns_in_a_penalty_area_but_not_be_too_many_together(new_rig):
    rig = new_rig().playing()
    inside, outside = (rig.pitch.goal_line - 1.5, 1.0), (5.0, 1.0)
    rig.robots |= {"cyan3": inside, "cyan4": outside}
    rig.play_on(8.0)
    rig.robots |= {"cyan3": outside, "cyan4": inside}
    rig.play_on(8.0)
    assert EventKind.FOUL not in rig.kinds()


def test_a_struggle_gives_the_right_to_drive_backward_anew(new_rig):
    rig = new_rig().playing()
    drive_backward(rig, 1.9)
    rig.robots |= {"cyan3": (-0.4, 2.0), "magenta2": (0.4, 2.0)}
    hold(rig, "cyan3", 2.2, (0.0, 2.0))
    rig.robots["magenta2"] = (5.0, 2.0)
    hold(rig, "cyan3", 1.9, motions={"cyan3": (0.0, -1.0, 0.0)})
    assert EventKind.FOUL not in rig.kinds()


def test_a_lob_is_free_for_a_side_of_fewer_than_three(new_rig):
    rig = new_rig().playing()
    for number in (2, 4, 5):
        rig.robots[f"cyan{number}"] = (float(number), rig.pitch.touch_line + 1.0)
    rig.tick()
    lob(rig, 0.9)
    assert EventKind.FOUL not in rig.kinds()


def test_a_robot_that_is_back_on_the_field_is_a_teammate_for_a_lob(new_rig):
    rig = new_rig().playing()
    rig.robots["cyan4"] = (4.0, rig.pitch.touch_line + 1.0)
    rig.play_on(5.0)
    lob(rig, 0.9, mate_at=(4.0, 0.0))
    assert EventKind.FOUL not in rig.kinds()


def test_the_free_kick_for_a_lob_lies_on_the_halfway_line(new_rig):
    rig = new_rig().playing()
    lob(rig, 0.9)
    assert rig.state.pending.spot == pytest.approx((0.0, 1.0))


def test_a_lob_that_somebody_touches_in_the_air_is_not_judged(new_rig):
    rig = new_rig().playing()
    rig.tick((-2.0, 1.0, 0.2), ["cyan3"], kicked="cyan3")
    rig.tick((0.0, 1.0, 1.0), ["magenta3"])
    rig.tick((3.0, 1.0))
    assert EventKind.FOUL not in rig.kinds()


@pytest.mark.parametrize(
    ("touches", "counts"),
    [
        ((("cyan3", 2.0),), True),
        ((("magenta2", -2.0), ("cyan3", -2.0), ("cyan3", 5.0)), False),
        ((("magenta2", -2.0), ("cyan3", -2.0), ("cyan4", 0.5)), True),
        ((("magenta2", -2.0), ("cyan3", -4.0), ("cyan4", -2.0), ("cyan4", 5.0)), False),
        ((("magenta2", -2.0), ("cyan3", -2.0), ("cyan4", 5.0), ("magenta2", 6.0), ("cyan3", 6.0)), True),
        ((("magenta2", 2.0), ("cyan3", 2.0)), True),
        ((("cyan3", -2.0), ("magenta2", 8.0)), True),
    ],
)
def test_a_ball_won_in_the_own_half_needs_a_pass_in_the_other(new_rig, touches, counts):
    rig = new_rig().playing()
    goal_after(*touches)(rig, 0.0)
    assert (EventKind.GOAL in rig.kinds()) is counts
    assert (EventKind.NO_GOAL in rig.kinds()) is not counts


@pytest.mark.parametrize(
    ("x", "seen", "phase", "taker"),
    [
        (-2.0, {}, Phase.GOAL_KICK, MAGENTA),
        (2.0, {}, Phase.CORNER, CYAN),
        (-2.0, {"possession": "magenta3"}, Phase.CORNER, CYAN),
    ],
)
def test_a_kick_from_the_own_half_that_grazes_a_defender_on_its_way_out_is_a_goal_kick(new_rig, x, seen, phase, taker):
    rig = new_rig().playing()
    rig.tick((x, 4.0), ["cyan3"], kicked="cyan3")
    rig.tick((8.0, 4.0), ["magenta3"], **seen)
    rig.tick((rig.pitch.goal_line - 0.1, 4.0))
    rig.tick((rig.pitch.goal_line + 0.2, 4.0))
    assert (rig.state.pending.phase, rig.state.pending.side) == (phase, taker)


@pytest.mark.parametrize(
    ("touches", "kind"), [(("cyan3",), EventKind.NO_GOAL), (("cyan3", "magenta2"), EventKind.GOAL)]
)
def test_straight_from_the_own_restart_into_the_own_goal_is_a_corner(new_rig, touches, kind):
    rig = new_rig().playing()
    rig.ask("free_kick", CYAN, (-6.0, 2.0))
    rig.until(lambda state: state.running)
    rig.tick((-6.0, 2.0), [touches[0]], kicked=touches[0])
    rig.tick((-8.0, 0.5), touches[1:], possession=touches[-1] if len(touches) > 1 else None)
    rig.tick((-rig.pitch.goal_line + 0.1, 0.5))
    ruling = rig.tick((-rig.pitch.goal_line - 0.2, 0.5))
    assert ruling.events[0].kind is kind
    if kind is EventKind.NO_GOAL:
        assert ruling.events[0].rule == "own_goal_kick"
        assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.CORNER, MAGENTA)


def test_the_scrum_is_dropped_where_both_had_the_ball(new_rig):
    rig = new_rig().playing()
    contest(rig, 10.02)
    assert rig.state.pending.spot == pytest.approx((5.0, 1.0)) and rig.state.pending.side is None


def test_the_rules_page_documents_that_no_advantage_is_played(new_rig):
    _, event = told(new_rig, CASES["pushing"], CASES["pushing"].breaks)
    assert event.text.startswith("cyan3 pushed magenta2 0.5") and "no advantage is played" in event.text
    assert "intent is not judged" in event.text


@pytest.mark.parametrize("rules", SHIPPED)
def test_nothing_is_called_while_everybody_stands_where_he_may(new_rig, rules):
    rig = new_rig("msl", rules).playing()
    rig.play_on(20.0)
    assert EventKind.FOUL not in rig.kinds()


def test_a_robot_that_the_referee_has_off_the_field_has_not_left_it(new_rig):
    rig = new_rig().playing()
    rig.ask("repair", robot="cyan3")
    rig.until(lambda state: "cyan3" in state.participation.absences)
    rig.until(lambda state: state.phase is Phase.PLAY or state.running)
    stay_outside(rig, 15.0)
    assert not [event for event in rig.events if event.rule == "leaving_field"]
