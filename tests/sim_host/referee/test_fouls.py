"""Each foul: the least case that breaks the rule, the nearest that does not, and the same with the colours swapped."""

from collections.abc import Callable
from typing import NamedTuple

import pytest

from schemas.game import Card, EventKind, Phase
from schemas.rule_book import SHIPPED
from schemas.side import Side
from sim_host.referee.rules import OCCASIONS, RULES, _asked, _occasions
from sim_host.referee.scene import Scene

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
NOT_AT_ALL = (0.0, 1e-9)
"""rad/s."""


def hold(bench, robot, seconds, place=None, **seen):
    """A robot holds the ball for a while."""
    for _ in range(round(seconds / bench.dt)):
        bench.tick(place, [robot], possession=robot, **seen)


def dribble_away(bench, way):
    bench.tick((-1.0, 2.0), ["cyan3"], possession="cyan3")
    for share in (0.3, 0.7, 1.0):
        bench.tick((-1.0 + share * way, 2.0), ["cyan3"], possession="cyan3")


def dribble_far_with_a_release(bench, air):
    """Twice 2 m, the ball out of the hold in between, with so much air before the hull."""
    for x in (-2.0, 0.0):
        bench.tick((x, 2.0), ["cyan3"], possession="cyan3")
    bench.robots["cyan3"] = (0.0, 2.0)
    bench.tick((bench.hull + bench.radius + air, 2.0))
    for x in (0.4, 1.8):
        bench.tick((x, 2.0), ["cyan3"], possession="cyan3")


def drive_backward(bench, way):
    bench.tick((0.0, 2.0), ["cyan3"], possession="cyan3")
    hold(bench, "cyan3", way, motions={"cyan3": (0.0, -1.0, 0.0)})


def drive_backward_again(bench, way):
    drive_backward(bench, 1.1)
    hold(bench, "cyan3", 0.6)
    hold(bench, "cyan3", way, motions={"cyan3": (0.0, -1.0, 0.0)})


def drive_backward_in_two_goes(bench, first):
    drive_backward(bench, first)
    hold(bench, "cyan3", 0.6)
    hold(bench, "cyan3", 0.9, motions={"cyan3": (0.0, -1.0, 0.0)})


def drag_without_roll(bench, way):
    bench.velocity = (1.0, 0.0, 0.0)
    hold(bench, "cyan3", way + bench.dt, (0.0, 2.0), spin=NOT_AT_ALL)


def drag_slowly(bench, seconds):
    bench.velocity = (0.2, 0.0, 0.0)
    hold(bench, "cyan3", seconds + bench.dt, (0.0, 2.0), spin=NOT_AT_ALL)


def drag_turning(bench, share):
    """2 m, with a ball that turns at so much of its natural rate."""
    bench.velocity = (1.0, 0.0, 0.0)
    hold(bench, "cyan3", 2.0, (0.0, 2.0), spin=(0.0, share / bench.radius))


def keep_long(bench, seconds):
    bench.tick((0.0, 2.0), ["cyan3"], possession="cyan3")
    hold(bench, "cyan3", seconds)


def stand_in_goal_area(name, end, depth=0.3):
    def story(bench, seconds):
        bench.robots[name] = (end * (bench.pitch.goal_line - depth), 0.5)
        bench.run(seconds)

    return story


def stand_before_goal_area(bench, margin):
    bench.robots["cyan3"] = (bench.pitch.goal_line - bench.pitch.goal_area_depth - margin, 0.5)
    bench.run(0.6)


def crowd(end, names):
    def story(bench, seconds):
        for place, name in enumerate(names):
            bench.robots[name] = (end * (bench.pitch.goal_line - 1.5), 0.8 * place)
        bench.run(seconds)

    return story


def push(bench, way, x=0.0):
    bench.robots |= {"cyan3": (x, 2.0), "magenta2": (x + 0.5, 2.0)}
    moving = {"cyan3": (0.0, 1.0, 0.0), "magenta2": (0.0, 1.0, 0.0)}
    for _ in range(round(way / bench.dt)):
        bench.tick(motions=moving, contacts=[("cyan3", "magenta2")])


def push_in_own_area(bench, way):
    push(bench, way, -bench.pitch.goal_line + 1.5)


def lean(bench, seconds):
    bench.robots |= {"cyan3": (0.0, 2.0), "magenta2": (0.5, 2.0)}
    against = {"cyan3": (0.0, 0.2, 0.0), "magenta2": (0.0, -0.2, 0.0)}
    for _ in range(round(seconds / bench.dt)):
        bench.tick(motions=against, contacts=[("cyan3", "magenta2")])


def contest(bench, seconds):
    bench.robots |= {"cyan3": (-0.4, 1.0), "magenta2": (0.4, 1.0)}
    bench.tick((0.0, 1.0))
    bench.run(seconds)


def contest_on_the_way(bench, way):
    """10 s, the ball moved once by so much in the middle."""
    contest(bench, 6.0)
    bench.robots |= {"cyan3": (-0.4 + way, 1.0), "magenta2": (0.4 + way, 1.0)}
    bench.tick((way, 1.0))
    bench.run(4.0)


def lob(bench, apex, kick_from=-2.0, mate_at=None):
    bench.robots["cyan3"] = (kick_from, 1.0)
    if mate_at is not None:
        bench.robots["cyan4"] = mate_at
    bench.tick((kick_from + 0.4, 1.0, bench.radius + 0.02), ["cyan3"], kicked="cyan3")
    bench.tick((1.0, 1.0, bench.radius + apex))
    bench.tick((4.0, 1.0, bench.radius + 0.01))


def lob_from(bench, x):
    lob(bench, 0.9, kick_from=x)


def lob_to_mate(bench, away):
    lob(bench, 0.9, mate_at=(4.0, 1.0 - away))


def goal_after(*touches):
    """A goal of cyan's after these touches: (robot, x)."""

    def story(bench, _amount):
        for robot, x in touches:
            bench.tick((x, 0.5), [robot], kicked=robot)
        bench.tick((bench.pitch.goal_line - 0.1, 0.5))
        bench.tick((bench.pitch.goal_line + 0.2, 0.5))

    return story


def shoot_from(bench, x):
    bench.tick((1.0, 0.5), ["magenta2"], kicked="magenta2")
    bench.tick((1.0, 0.5), ["cyan3"], possession="cyan3")
    bench.tick((x, 0.5), ["cyan3"], kicked="cyan3")
    bench.tick((bench.pitch.goal_line - 0.1, 0.5))
    bench.tick((bench.pitch.goal_line + 0.2, 0.5))


def score_after_a_pass_of(bench, roll):
    """Won in the own half by cyan, passed in the other half."""
    bench.tick((-2.0, 0.5), ["magenta2"], kicked="magenta2")
    bench.tick((-2.0, 0.5), ["cyan3"], kicked="cyan3")
    bench.tick((3.0, 0.5), ["cyan3"], kicked="cyan3")
    bench.tick((3.0 + roll, 0.5), ["cyan4"], kicked="cyan4")
    bench.tick((bench.pitch.goal_line - 0.1, 0.5))
    bench.tick((bench.pitch.goal_line + 0.2, 0.5))


def stay_outside(bench, seconds):
    bench.robots["cyan3"] = (1.0, bench.pitch.touch_line + bench.hull + 0.01)
    bench.run(seconds)


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
        "penalty_area", crowd(1, ("cyan3", "cyan4")), 10.04, 9.96, offenders=("cyan4", "cyan3")
    ),
    "illegal defence, penalty area": Case(
        "penalty_area", crowd(-1, ("cyan1", "cyan3", "cyan4")), 10.04, 9.96, offenders=("cyan4", "cyan3")
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


def told(new_bench, case, amount, mirrored=False):
    """The bench after the story, and the first event of the case's rule."""
    bench = new_bench("msl", case.rules, mirrored=mirrored).playing((1.0, 0.0))
    case.story(bench, amount)
    return bench, next((event for event in bench.events if event.rule == case.rule), None)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_least_case_is_called_with_its_measure_and_the_nearest_other_is_not(new_bench, case):
    """Reference 10.5, 10.6; reference 14, defect 16."""
    bench, event = told(new_bench, case, case.breaks)
    assert event is not None and event.kind is case.kind
    assert event.measured is not None and event.unit in ("m", "s")
    assert f"{event.limit:.1f}" in event.text and event.place is not None
    assert (tuple(event.robots) or (event.robot,)) == case.offenders
    assert all(name in event.text for name in case.offenders) or case.rule == "scrum"
    assert event.card is case.card
    assert (bench.state.pending.phase, bench.state.pending.side) == (case.restart, case.taker)
    _, nothing = told(new_bench, case, case.allowed)
    assert nothing is None


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_colours_swapped_the_same_is_decided(new_bench, case):
    bench, event = told(new_bench, case, case.breaks)
    turned, mirror = told(new_bench, case, case.breaks, mirrored=True)
    assert mirror is not None and (mirror.tick, mirror.measured) == (event.tick, pytest.approx(event.measured))
    assert (-mirror.place.x, -mirror.place.y) == pytest.approx((event.place.x, event.place.y))
    assert mirror.robot == (event.robot and turned.robot(event.robot))
    assert sorted(mirror.robots) == sorted(turned.robot(name) for name in event.robots)
    spot, other = bench.state.pending.spot, turned.state.pending.spot
    assert (-other[0], -other[1]) == pytest.approx(spot)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_spot_of_the_restart_is_on_the_field_and_out_of_penalty_areas(new_bench, case):
    bench, _ = told(new_bench, case, case.breaks)
    x, y = bench.state.pending.spot
    pitch = bench.pitch
    assert abs(x) <= pitch.goal_line - pitch.penalty_area_depth or abs(y) >= pitch.penalty_area_width / 2
    assert abs(y) <= pitch.touch_line


@pytest.mark.parametrize("rule", ["own_half_goal", "dribble_circle", "backward", "not_rolling", "lob", "leaving_field"])
def test_a_friendly_forgives(new_bench, rule):
    for case in CASES.values():
        if case.rule == rule:
            _, event = told(new_bench, case._replace(rules="friendly"), case.breaks)
            assert event is None


def test_the_goalkeeper_may_be_in_its_goal_area_and_beside_one_other_in_its_penalty_area(new_bench):
    bench = new_bench().playing()
    bench.robots |= {"cyan1": (-bench.pitch.goal_line + 0.3, 0.0), "cyan3": (-bench.pitch.goal_line + 1.5, 1.0)}
    bench.run(12.0)
    assert EventKind.FOUL not in bench.kinds()


@pytest.mark.parametrize("deed", ["repair", "red_card"])
def test_while_the_goalkeeper_is_off_the_field_the_first_robot_on_it_keeps_the_goal_and_no_other(new_bench, deed):
    bench = new_bench().playing()
    bench.ask(deed, robot="cyan1")
    bench.robots["cyan2"] = (-bench.pitch.goal_line + 0.3, 0.5)
    bench.run(3.0)
    assert EventKind.FOUL not in bench.kinds()
    bench.robots |= {"cyan3": (-bench.pitch.goal_line + 0.3, -0.7)}
    bench.run(3.0)
    assert [event.robot for event in bench.events if event.kind is EventKind.FOUL] == ["cyan3"]


def test_when_the_goalkeeper_is_back_who_stood_in_for_it_leaves_the_goal_area(new_bench):
    bench = new_bench().playing()
    bench.ask("repair", robot="cyan1")
    bench.run(bench.book.people.repair)
    bench.ask("stop")
    bench.until(lambda state: "cyan1" not in state.people.away)
    bench.ask("free_kick", Side.MAGENTA, (4.0, 0.0))
    bench.robots["cyan2"] = (-bench.pitch.goal_line + 0.3, 0.5)
    bench.until(lambda state: state.running)
    bench.run(3.0)
    assert [event.robot for event in bench.events if event.kind is EventKind.FOUL] == ["cyan2"]


@pytest.mark.parametrize("behind", [0.6, 5.0])
def test_behind_the_goal_line_and_out_of_the_goal_nobody_is_in_an_area(new_bench, behind):
    """The older referee had no limit along x (reference 14, defect 16)."""
    bench = new_bench().playing()
    bench.robots["cyan3"] = (bench.pitch.goal_line + behind, 0.5)
    bench.run(3.0)
    assert EventKind.FOUL not in bench.kinds()


def test_two_robots_may_take_turns_in_a_penalty_area_but_not_be_too_many_together(new_bench):
    bench = new_bench().playing()
    inside, outside = (bench.pitch.goal_line - 1.5, 1.0), (5.0, 1.0)
    bench.robots |= {"cyan3": inside, "cyan4": outside}
    bench.run(8.0)
    bench.robots |= {"cyan3": outside, "cyan4": inside}
    bench.run(8.0)
    assert EventKind.FOUL not in bench.kinds()


def test_a_struggle_gives_the_right_to_drive_backward_anew(new_bench):
    bench = new_bench().playing()
    drive_backward(bench, 1.9)
    bench.robots |= {"cyan3": (-0.4, 2.0), "magenta2": (0.4, 2.0)}
    hold(bench, "cyan3", 2.2, (0.0, 2.0))
    bench.robots["magenta2"] = (5.0, 2.0)
    hold(bench, "cyan3", 1.9, motions={"cyan3": (0.0, -1.0, 0.0)})
    assert EventKind.FOUL not in bench.kinds()


def test_a_lob_is_free_for_a_side_of_fewer_than_three(new_bench):
    bench = new_bench().playing()
    for number in (2, 4, 5):
        bench.robots[f"cyan{number}"] = (float(number), bench.pitch.touch_line + 1.0)
    bench.tick()
    lob(bench, 0.9)
    assert EventKind.FOUL not in bench.kinds()


def test_the_free_kick_for_a_lob_lies_on_the_halfway_line(new_bench):
    bench = new_bench().playing()
    lob(bench, 0.9)
    assert bench.state.pending.spot == pytest.approx((0.0, 1.0))


def test_a_lob_that_somebody_touches_in_the_air_is_not_judged(new_bench):
    bench = new_bench().playing()
    bench.tick((-2.0, 1.0, 0.2), ["cyan3"], kicked="cyan3")
    bench.tick((0.0, 1.0, 1.0), ["magenta3"])
    bench.tick((3.0, 1.0))
    assert EventKind.FOUL not in bench.kinds()


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
def test_a_ball_won_in_the_own_half_needs_a_pass_in_the_other(new_bench, touches, counts):
    bench = new_bench().playing()
    goal_after(*touches)(bench, 0.0)
    assert (EventKind.GOAL in bench.kinds()) is counts
    assert (EventKind.NO_GOAL in bench.kinds()) is not counts


@pytest.mark.parametrize(
    ("x", "seen", "phase", "taker"),
    [
        (-2.0, {}, Phase.GOAL_KICK, MAGENTA),
        (2.0, {}, Phase.CORNER, CYAN),
        (-2.0, {"possession": "magenta3"}, Phase.CORNER, CYAN),
    ],
)
def test_a_kick_from_the_own_half_that_grazes_a_defender_on_its_way_out_is_a_goal_kick(
    new_bench, x, seen, phase, taker
):
    bench = new_bench().playing()
    bench.tick((x, 4.0), ["cyan3"], kicked="cyan3")
    bench.tick((8.0, 4.0), ["magenta3"], **seen)
    bench.tick((bench.pitch.goal_line - 0.1, 4.0))
    bench.tick((bench.pitch.goal_line + 0.2, 4.0))
    assert (bench.state.pending.phase, bench.state.pending.side) == (phase, taker)


@pytest.mark.parametrize(
    ("touches", "kind"), [(("cyan3",), EventKind.NO_GOAL), (("cyan3", "magenta2"), EventKind.GOAL)]
)
def test_straight_from_the_own_restart_into_the_own_goal_is_a_corner(new_bench, touches, kind):
    bench = new_bench().playing()
    bench.ask("free_kick", CYAN, (-6.0, 2.0))
    bench.until(lambda state: state.running)
    bench.tick((-6.0, 2.0), [touches[0]], kicked=touches[0])
    bench.tick((-8.0, 0.5), touches[1:], possession=touches[-1] if len(touches) > 1 else None)
    bench.tick((-bench.pitch.goal_line + 0.1, 0.5))
    ruling = bench.tick((-bench.pitch.goal_line - 0.2, 0.5))
    assert ruling.events[0].kind is kind
    if kind is EventKind.NO_GOAL:
        assert (bench.state.pending.phase, bench.state.pending.side) == (Phase.CORNER, MAGENTA)


def test_the_scrum_is_dropped_where_both_had_the_ball(new_bench):
    """Reference 13, row 40."""
    bench = new_bench().playing()
    contest(bench, 10.02)
    assert bench.state.pending.spot == pytest.approx((0.0, 1.0)) and bench.state.pending.side is None


def test_the_referee_says_that_it_plays_no_advantage(new_bench):
    _, event = told(new_bench, CASES["pushing"], CASES["pushing"].breaks)
    assert event.text.startswith("cyan3 pushed magenta2 0.5") and "no advantage is played" in event.text
    assert "intent is not judged" in event.text


@pytest.mark.parametrize("rules", SHIPPED)
def test_nothing_is_called_while_everybody_stands_where_he_may(new_bench, rules):
    bench = new_bench("msl", rules).playing()
    bench.run(20.0)
    assert EventKind.FOUL not in bench.kinds()


def test_a_robot_that_the_referee_has_off_the_field_has_not_left_it(new_bench):
    bench = new_bench().playing()
    bench.ask("repair", robot="cyan3")
    bench.until(lambda state: "cyan3" in state.people.away)
    bench.until(lambda state: state.phase is Phase.PLAY or state.running)
    stay_outside(bench, 15.0)
    assert not [event for event in bench.events if event.rule == "leaving_field"]


def test_a_quiet_tick_asks_few_rules(new_bench):
    """Every rule's occasion is one that ticks have; in a quiet one, only lost balls and the clock are looked at."""
    bench = new_bench().playing()
    ruling = bench.tick((1.2, 0.0))
    there = _occasions(Scene(bench.referee._match, ruling.state, bench.snapshot(), None))
    assert {rule.occasion for rule in RULES} == {"always", *OCCASIONS} and len(there) == len(OCCASIONS)
    assert [rule.name for rule in _asked("running", there)] == ["lost_ball", "half_end"]
