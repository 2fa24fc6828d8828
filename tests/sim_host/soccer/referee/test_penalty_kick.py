"""Robots that leave their places at a penalty before the kick, in play and in a shoot-out."""

import pytest

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, OfficiatingMode, Phase, Score
from sim_host.soccer.referee.placement.positions import position_faults

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
KEEPER_OUT = {"magenta1": (10.0, 0.0)}
DEFENDER_IN = {"magenta3": (9.5, 1.0)}
DEFENDER_NEAR = {"magenta3": (5.0, 1.0)}
DEFENDER_AHEAD = {"magenta3": (8.0, 5.0)}
MATE_IN = {"cyan3": (9.5, -1.0)}
MATE_AHEAD = {"cyan3": (8.0, -5.0)}
DEFENDERS = [KEEPER_OUT, DEFENDER_IN, DEFENDER_NEAR, DEFENDER_AHEAD]
ATTACKERS = [MATE_IN, MATE_AHEAD]


def names(strays):
    return "+".join(strays)


def started(new_rig, rules="msl", **options):
    """START of a penalty of cyan's, with all robots in their places."""
    rig = new_rig("msl", rules, **options).playing()
    rig.ask("penalty", CYAN)
    rig.until(lambda state: state.phase is Phase.PENALTY)
    places(rig)
    rig.until(lambda state: state.running)
    assert EventKind.FOUL not in rig.kinds()
    rig.events = []
    return rig


def places(rig):
    for number in range(1, 6):
        rig.robots[f"cyan{number}"] = (2.0, -1.0 * number)
        rig.robots[f"magenta{number}"] = (2.0, 1.0 * number)
    rig.robots |= {"cyan2": (6.9, 0.0), "magenta1": (10.6, 0.0)}


def stray(rig, robots, ticks=1):
    """Robots leave their places for some ticks, and return."""
    before = {name: rig.robots[name] for name in robots}
    rig.robots |= robots
    for _ in range(ticks):
        rig.tick()
    rig.robots |= before


def kick(rig, scores):
    """The penalty is kicked into the goal, or beside it."""
    x, y = rig.state.spot
    rig.velocity = (6.0, 0.0, 0.0)
    rig.tick((x, y), ["cyan2"], kicked="cyan2")
    for _ in range(6):
        rig.tick((rig.ball[0] + 0.12, 0.0))
    beside = 0.0 if scores else rig.pitch.goal_width
    rig.tick((rig.pitch.goal_line - 0.1, beside))
    return rig.tick((rig.pitch.goal_line + 0.3, beside))


def roll(rig):
    """The penalty is kicked, and the ball is 0.6 m from its spot in the next tick."""
    rig.tick(rig.state.spot, ["cyan2"], kicked="cyan2")
    rig.velocity = (6.0, 0.0, 0.0)
    rig.tick((rig.ball[0] + 0.6, 0.0))


def fouls(rig):
    return [event for event in rig.events if event.kind is EventKind.FOUL]


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("strays", DEFENDERS, ids=names)
def test_a_penalty_that_misses_is_taken_again_if_a_defender_left_its_place(new_rig, strays, mirrored):
    rig = started(new_rig, mirrored=mirrored)
    (name,) = strays
    stray(rig, strays)
    kick(rig, scores=False)
    (foul,) = fouls(rig)
    assert (foul.rule, foul.robot, foul.card) == ("penalty_kick", rig.robot(name), Card.YELLOW)
    assert "taken again" in foul.text and EventKind.BALL_OUT not in rig.kinds()
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.PENALTY, rig.side(CYAN))
    assert rig.state.participation.cards[rig.robot(name)].yellow == 1


@pytest.mark.parametrize("strays", DEFENDERS, ids=names)
def test_a_goal_stands_if_a_defender_left_its_place(new_rig, strays):
    rig = started(new_rig)
    stray(rig, strays)
    kick(rig, scores=True)
    assert fouls(rig) == [] and rig.state.score == Score(cyan=1)
    assert rig.state.pending.phase is Phase.KICK_OFF and EventKind.CARD not in rig.kinds()


@pytest.mark.parametrize("strays", ATTACKERS, ids=names)
def test_a_goal_does_not_count_if_an_attacker_left_its_place(new_rig, strays):
    rig = started(new_rig)
    stray(rig, strays)
    kick(rig, scores=True)
    (foul,) = fouls(rig)
    assert (foul.robot, rig.state.score) == ("cyan3", Score()) and "does not count" in foul.text
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.PENALTY, CYAN)


@pytest.mark.parametrize("strays", ATTACKERS, ids=names)
def test_a_miss_gives_the_other_side_a_free_kick_if_an_attacker_left_its_place(new_rig, strays):
    rig = started(new_rig)
    spot = rig.state.spot
    stray(rig, strays)
    kick(rig, scores=False)
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, MAGENTA)
    assert rig.state.pending.spot == pytest.approx(spot)


@pytest.mark.parametrize("scores", [False, True])
def test_if_robots_of_both_sides_left_their_places_the_penalty_is_taken_again_without_a_card(new_rig, scores):
    rig = started(new_rig)
    stray(rig, MATE_IN | KEEPER_OUT)
    kick(rig, scores)
    (foul,) = fouls(rig)
    assert foul.robots == ["cyan3", "magenta1"] and foul.card is None and rig.state.score == Score()
    assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.PENALTY, CYAN)


@pytest.mark.parametrize("scores", [False, True])
def test_nothing_is_called_where_all_keep_their_places(new_rig, scores):
    """The goalkeeper moves within its goal area, the kicker where it likes."""
    rig = started(new_rig)
    stray(rig, {"magenta1": (rig.pitch.goal_line - rig.pitch.goal_area_depth + 0.01, 1.0), "cyan2": (8.0, 0.5)})
    kick(rig, scores)
    assert fouls(rig) == [] and rig.state.score == Score(cyan=int(scores))


def test_a_teammate_that_comes_nearer_to_the_ball_than_the_kicker_has_left_its_place_and_the_kicker_has_not(new_rig):
    rig = started(new_rig)
    rig.tick()
    stray(rig, {"cyan3": (7.0, 0.0), "cyan2": (6.5, 0.0)}, ticks=5)
    assert [one.robot for one in rig.state.set_piece.strays] == ["cyan3"]


def test_after_the_kick_robots_go_where_they_like(new_rig):
    rig = started(new_rig)
    rig.tick(rig.state.spot, ["cyan2"], kicked="cyan2")
    rig.robots |= KEEPER_OUT | DEFENDER_NEAR
    rig.velocity = (6.0, 0.0, 0.0)
    rig.tick((rig.ball[0] + 0.12, 0.0))
    assert rig.state.set_piece.strays == ()


@pytest.mark.parametrize("seen", [{"possession": "magenta1"}, {"touches": ["magenta4"]}, {"touches": ["cyan4"]}])
def test_a_saved_penalty_is_taken_again_as_soon_as_another_robot_has_the_ball(new_rig, seen):
    rig = started(new_rig)
    stray(rig, KEEPER_OUT)
    roll(rig)
    rig.run(1.0)
    assert rig.state.phase is Phase.PLAY and fouls(rig) == []
    rig.tick((rig.ball[0], 0.0), **seen)
    assert len(fouls(rig)) == 1 and rig.state.pending.phase is Phase.PENALTY


@pytest.mark.parametrize("speed", [-2.0, 0.0])
def test_a_penalty_that_rebounds_or_comes_to_rest_has_missed(new_rig, speed):
    rig = started(new_rig)
    stray(rig, KEEPER_OUT)
    roll(rig)
    rig.velocity = (speed, 0.0, 0.0)
    rig.tick()
    assert len(fouls(rig)) == 1 and rig.state.pending.phase is Phase.PENALTY


def test_a_keeper_that_strays_again_and_again_is_sent_off_and_the_penalties_end(new_rig):
    rig = started(new_rig)
    for _ in range(2):
        stray(rig, KEEPER_OUT)
        kick(rig, scores=False)
        places(rig)
        rig.until(lambda state: state.running)
    assert "magenta1" in rig.state.participation.absences


def test_people_who_overrule_the_retake_are_not_asked_again(new_rig):
    rig = started(new_rig, mode=OfficiatingMode.MIXED, proposal=5.0)
    stray(rig, KEEPER_OUT)
    roll(rig)
    rig.velocity = (-2.0, 0.0, 0.0)
    rig.tick()
    assert rig.state.proposal is not None
    rig.ask("overrule")
    rig.run(1.0)
    assert rig.state.proposal is None and rig.state.set_piece is None and fouls(rig) == []


def test_a_friendly_tolerates_it(new_rig):
    rig = started(new_rig, "friendly")
    stray(rig, KEEPER_OUT | MATE_IN)
    kick(rig, scores=True)
    assert fouls(rig) == [] and rig.state.score == Score(cyan=1)


@pytest.mark.parametrize(("ahead", "wrong"), [(-0.01, False), (0.01, True)])
def test_before_start_robots_wait_behind_the_ball(new_rig, ahead, wrong):
    rig = started(new_rig)
    x, _ = rig.state.spot
    rig.robots["magenta3"] = (x - rig.hull + ahead, 5.0)
    faults = position_faults(rig.constants, rig.state, rig.state.restart, rig.snapshot())
    assert [fault.robot for fault in faults] == (["magenta3"] if wrong else [])
    assert all("0.01 m ahead of the ball" in fault.text for fault in faults)


@pytest.fixture
def shoot_out(penalties):
    """START of the first penalty of a shoot-out."""
    wait(penalties)
    penalties.events = []
    return penalties


def wait(rig):
    """All robots wait for the penalty in their places; START is given."""
    rig.until(lambda state: state.phase is Phase.PENALTY)
    side, end = rig.state.side, rig.state.attack(rig.state.side)
    for number in range(1, 6):
        rig.robots[f"{side}{number}"] = (-3.0 * end, -1.0 * number)
        rig.robots[f"{side.opponent}{number}"] = (-3.0 * end, 1.0 * number)
    rig.robots |= {f"{side}2": (end * 1.0, 0.0), f"{side.opponent}1": (end * 10.6, 0.0)}
    rig.until(lambda state: state.running)


def attempt(rig, scores):
    kicker, end = f"{rig.state.side}2", rig.state.attack(rig.state.side)
    x, y = rig.state.spot
    rig.velocity = (6.0 * end, 0.0, 0.0)
    rig.tick((x, y), [kicker], kicked=kicker)
    for _ in range(6):
        rig.tick((rig.ball[0] + 0.12 * end, 0.0))
    beside = 0.0 if scores else rig.pitch.goal_width
    rig.tick((end * (rig.pitch.goal_line - 0.1), beside))
    rig.tick((end * (rig.pitch.goal_line + 0.3), beside))


def sides(rig):
    """Places of a straying goalkeeper, of a straying defender, of a straying attacker."""
    side, end = rig.state.side, rig.state.attack(rig.state.side)
    return (
        {f"{side.opponent}1": (end * 10.0, 0.0)},
        {f"{side.opponent}3": (end * 0.5, 3.0)},
        {f"{side}3": (end * 0.5, -3.0)},
    )


@pytest.mark.parametrize("who", [0, 1])
def test_an_attempt_that_misses_is_repeated_if_a_defender_left_its_place(shoot_out, who):
    side = shoot_out.state.side
    stray(shoot_out, sides(shoot_out)[who])
    attempt(shoot_out, scores=False)
    assert [event.rule for event in fouls(shoot_out)] == ["penalty_kick"]
    assert shoot_out.state.shoot_out.taken == Score() and shoot_out.state.shoot_out.nearest is None
    assert (shoot_out.state.pending.phase, shoot_out.state.pending.side) == (Phase.PENALTY, side)
    wait(shoot_out)
    attempt(shoot_out, scores=True)
    assert shoot_out.state.shoot_out.goals.of(side) == 1 and shoot_out.state.shoot_out.taken.of(side) == 1


def test_an_attempt_counts_only_as_a_miss_if_an_attacker_left_its_place(shoot_out):
    side = shoot_out.state.side
    stray(shoot_out, sides(shoot_out)[2])
    attempt(shoot_out, scores=True)
    assert len(fouls(shoot_out)) == 1 and shoot_out.state.shoot_out.taken == Score()
    wait(shoot_out)
    stray(shoot_out, sides(shoot_out)[2])
    attempt(shoot_out, scores=False)
    assert len(fouls(shoot_out)) == 1 and shoot_out.state.shoot_out.taken.of(side) == 1


def test_the_goalkeeper_may_come_out_once_the_kicker_has_touched_the_ball_and_the_others_may_not(shoot_out):
    keeper, defender, _ = sides(shoot_out)
    kicker = f"{shoot_out.state.side}2"
    shoot_out.tick(shoot_out.state.spot, [kicker], possession=kicker)
    stray(shoot_out, keeper)
    assert shoot_out.state.set_piece.strays == ()
    stray(shoot_out, defender)
    assert [one.robot for one in shoot_out.state.set_piece.strays] == list(defender)
