"""Extra time and penalties: when they are played, how long, and who wins."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, GameStage, Phase, Score
from sim_host.soccer.referee.placement.positions import position_faults

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA


def ended(rig, halves):
    """So many halves are over, ended by word."""
    for _ in range(halves):
        rig.playing()
        rig.ask("end_half")
        half = rig.state.half
        rig.until(
            lambda state, half=half: state.half > half or state.stage is GameStage.SHOOT_OUT or over(state), 200.0
        )
    return rig


def over(state):
    return state.phase is Phase.FULL_TIME


@pytest.mark.parametrize(("winner", "goes_on"), [(None, False), (False, False), (True, True)])
def test_extra_time_is_played_when_the_match_asks_for_a_winner_and_is_level(rig, new_rig, winner, goes_on):
    rig = ended(new_rig(rig.book.name, winner=winner), 2)
    assert over(rig.state) != goes_on
    if goes_on:
        assert (rig.state.stage, rig.state.half) == (GameStage.EXTRA_TIME, 3)


def test_a_match_that_has_a_winner_is_over_after_its_halves(new_rig):
    rig = new_rig(winner=True)
    rig.playing()
    rig.ask("goal", CYAN)
    ended(rig, 2)
    assert over(rig.state) and rig.state.score == Score(cyan=1)


@pytest.mark.parametrize(("duration", "extra"), [(None, 300.0), (180.0, 30.0)])
def test_extra_time_is_two_halves_a_third_as_long_with_change_of_sides(new_rig, duration, extra):
    rig = ended(new_rig(winner=True, duration=duration), 2)
    first = rig.state
    assert first.timing.limit - first.clock == pytest.approx(extra)
    assert (first.cyan_attacks, first.kick_off) == (1, CYAN)
    ended(rig, 1)
    assert (rig.state.half, rig.state.cyan_attacks, rig.state.kick_off) == (4, -1, MAGENTA)
    assert rig.state.stage is GameStage.EXTRA_TIME


def test_extra_time_is_played_to_its_end_also_after_a_goal(new_rig):
    rig = ended(new_rig(winner=True), 2)
    rig.playing()
    rig.ask("goal", MAGENTA)
    ended(rig, 1)
    assert rig.state.half == 4
    ended(rig, 1)
    assert over(rig.state) and "magenta" in rig.events[-1].text


def started(rig):
    return rig.until(lambda state: state.running, 120.0)


def mark(rig):
    return rig.state.attack(rig.state.side) * (rig.pitch.goal_line - rig.pitch.penalty_mark)


def kicker(rig):
    return f"{rig.state.side}2"


def attempt(rig, scores):
    """One penalty, kicked into the goal or beside it."""
    started(rig)
    x = mark(rig)
    rig.tick((x, 0.0), [kicker(rig)], possession=kicker(rig))
    rig.tick((x, 0.0), [kicker(rig)], kicked=kicker(rig))
    end = 1 if x > 0 else -1
    y = 0.0 if scores else rig.pitch.goal_width
    rig.tick((end * (rig.pitch.goal_line - 0.1), y))
    return rig.tick((end * (rig.pitch.goal_line + 0.3), y))


def test_a_level_match_goes_to_penalties_from_the_mark_and_the_clock_stands(penalties):
    clock = penalties.state.clock
    assert penalties.state.phase is Phase.PENALTY and penalties.ball[:2] == pytest.approx((mark(penalties), 0.0))
    started(penalties)
    penalties.run(5.0)
    assert penalties.state.clock == clock and penalties.state.score == Score()


def test_sides_alternate_and_a_goal_of_the_shoot_out_is_none_of_the_match(penalties):
    first = penalties.state.side
    ruling = attempt(penalties, True)
    assert ruling.events[0].kind is EventKind.SHOT and ruling.events[0].rule == "shoot_out"
    assert ruling.events[0].score.of(first) == 1
    assert penalties.state.score == Score() and penalties.state.shoot_out.goals.of(first) == 1
    assert penalties.state.pending.side is first.opponent


@pytest.mark.parametrize(("goals", "attempts"), [("1010101", 6), ("1110111111", 9), ("1111111110", 10)])
def test_the_shoot_out_is_over_as_soon_as_one_side_cannot_be_caught_up_with(penalties, goals, attempts):
    """Three ahead with two left each is decided, two ahead with one left, too; one behind, the tenth decides."""
    made = 0
    for scores in goals:
        attempt(penalties, scores == "1")
        made += 1
        if over(penalties.state):
            break
    assert made == attempts and "wins the penalty shoot-out" in penalties.events[-1].text


def test_a_level_shoot_out_is_repeated_once_with_the_other_side_first_and_then_reported_as_undecided(penalties):
    first = penalties.state.side
    for _ in range(10):
        attempt(penalties, True)
    assert penalties.state.pending.side is first.opponent and penalties.state.shoot_out.series == 2
    for _ in range(10):
        attempt(penalties, True)
    assert over(penalties.state) and "undecided" in penalties.events[-1].text


def shots(rig):
    return [event for event in rig.events if event.kind is EventKind.SHOT]


def test_an_attempt_ends_without_a_goal_when_its_30_s_are_up(penalties):
    started(penalties).run(penalties.book.periods.shoot_out_limit - 0.1)
    assert shots(penalties) == []
    penalties.run(0.12)
    assert penalties.state.shoot_out.taken.of(Side.CYAN) + penalties.state.shoot_out.taken.of(Side.MAGENTA) == 1
    assert shots(penalties)[0].limit == 30.0


@pytest.mark.parametrize(("inside", "missed"), [(-0.01, False), (0.01, True)])
def test_the_kick_comes_before_the_ball_enters_the_penalty_area(penalties, inside, missed):
    started(penalties)
    end = penalties.state.attack(penalties.state.side)
    x = end * (penalties.pitch.goal_line - penalties.pitch.penalty_area_depth + inside)
    penalties.tick((x, 0.0), [kicker(penalties)], possession=kicker(penalties))
    assert bool(shots(penalties)) == missed


@pytest.mark.parametrize(("back", "missed"), [(0.19, False), (0.21, True)])
def test_after_the_catch_the_ball_moves_toward_the_goal_alone(penalties, back, missed):
    started(penalties)
    x, end, taker = mark(penalties), penalties.state.attack(penalties.state.side), kicker(penalties)
    penalties.tick((x, 0.0), [taker], possession=taker)
    penalties.tick((x - end * back, 0.0), [taker], possession=taker)
    assert bool(shots(penalties)) == missed


@pytest.mark.parametrize(("later", "missed"), [(0.02, False), (0.3, True)])
def test_there_is_one_kick(penalties, later, missed):
    started(penalties)
    x, taker = mark(penalties), kicker(penalties)
    penalties.tick((x, 0.0), [taker], kicked=taker)
    penalties.run(later)
    penalties.tick((x, 0.0), [taker])
    assert bool(shots(penalties)) == missed


def test_a_ball_that_the_keeper_holds_or_that_lies_still_ends_the_attempt(penalties):
    started(penalties)
    x, keeper = mark(penalties), f"{penalties.state.side.opponent}1"
    penalties.tick((x, 0.0), [kicker(penalties)], kicked=kicker(penalties))
    penalties.tick((x, 0.0), [keeper], possession=keeper)
    assert keeper in shots(penalties)[0].text
    started(penalties)
    penalties.tick((mark(penalties), 0.0), [kicker(penalties)], kicked=kicker(penalties))
    penalties.velocity = (0.0, 0.0, 0.0)
    penalties.run(1.1)
    assert "at rest" in shots(penalties)[1].text


@pytest.mark.parametrize(
    ("robot", "place", "wrong"),
    [
        ("kicker", (0.0, 1.9), False),
        ("kicker", (0.0, 2.1), True),
        ("mate", (-2.4, 0.0), False),
        ("mate", (-2.1, 0.0), True),
        ("mate", (0.1, 4.0), True),
        ("keeper", (10.5, 0.0), False),
        ("keeper", (9.9, 0.0), True),
    ],
)
def test_where_robots_wait_for_a_penalty_of_the_shoot_out(penalties, robot, place, wrong):
    """The kicker in the centre circle, the keeper in its goal area, the others beyond halfway, out of the circle."""
    side, end = penalties.state.side, penalties.state.attack(penalties.state.side)
    for number, name in enumerate(penalties.robots):
        penalties.robots[name] = (-3.0 * end, -4.0 + 0.8 * number)
    penalties.robots[f"{side}2"] = (end * 1.0, 0.0)
    penalties.robots[f"{side.opponent}1"] = (end * 10.5, 0.0)
    name = {"kicker": f"{side}2", "mate": f"{side}3", "keeper": f"{side.opponent}1"}[robot]
    penalties.robots[name] = (end * place[0], end * place[1])
    faults = position_faults(penalties.constants, penalties.state, penalties.state.restart, penalties.snapshot())
    assert [fault.robot for fault in faults] == ([name] if wrong else [])


def test_stop_before_start_of_an_attempt_only_delays_it(penalties):
    side = penalties.state.side
    (reply,) = penalties.ask("stop").replies
    assert reply.accepted and penalties.events[-1].kind is EventKind.STOP
    assert penalties.state.shoot_out.taken == Score()
    assert (penalties.state.pending.phase, penalties.state.pending.side) == (Phase.PENALTY, side)


def test_people_count_and_end_attempts_by_word(penalties):
    side = started(penalties).state.side
    (refused,) = penalties.ask("goal", side.opponent).replies
    assert "is not taking a penalty" in refused.reason
    penalties.ask("goal", side)
    assert penalties.state.shoot_out.goals.of(side) == 1
    started(penalties)
    penalties.ask("stop")
    assert penalties.state.shoot_out.taken == Score(cyan=1, magenta=1)
    assert not penalties.ask("free_kick", CYAN).replies[0].accepted
    assert not penalties.ask("end_half").replies[0].accepted
