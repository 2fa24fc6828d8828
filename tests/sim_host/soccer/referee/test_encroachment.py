"""Encroachment: robots that come too near between START and the kick (MSL rule book, set pieces).

Each table holds the least case that breaks the rule and the nearest that does not.
"""

import pytest

from schemas.side import Side
from schemas.soccer.game import Phase

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
SPOT = (2.0, 1.0)


def started(rig, phase="free_kick", side=CYAN, taker="cyan2"):
    """START of a restart has been given, its taker beside the ball, all others far away."""
    rig.playing()
    rig.ask(phase, side, None if phase in ("penalty", "kick_off") else SPOT)
    rig.until(lambda state: state.spot is not None)
    x, y = rig.state.spot
    if taker:
        rig.robots[taker] = (x - rig.side_sign(taker) * (rig.hull + rig.radius + 0.05), y)
    rig.until(lambda state: state.running)
    rig.tick()
    rig.events.clear()
    return rig


def stand(rig, robot, distance, bearing=(0.0, 1.0)):
    """A robot stands with its hull so far from the spot."""
    x, y = rig.state.spot or rig.state.pending.spot
    away = distance + rig.hull
    rig.robots[robot] = (x + bearing[0] * away, y + bearing[1] * away)


@pytest.mark.parametrize("phase", ["free_kick", "throw_in", "corner", "goal_kick", "kick_off"])
@pytest.mark.parametrize(("distance", "called"), [(2.79, True), (2.81, False)])
def test_an_opponent_that_comes_too_near_before_the_kick_repeats_the_restart(new_rig, phase, distance, called):
    rig = started(new_rig(), phase)
    restart = rig.state.restart
    stand(rig, "magenta3", distance, (-1.0 if rig.state.spot[0] > 0.0 else 1.0, 0.0))
    rig.tick()
    assert rig.fouls() == ([("encroachment", "magenta3")] if called else [])
    if called:
        assert rig.state.pending == restart
        foul = rig.events[0]
        assert (foul.side, foul.limit, foul.unit) == (MAGENTA, 3.0, "m")
        assert foul.measured == pytest.approx(distance, abs=0.02)
        assert "magenta3, an opponent, encroached" in foul.text


@pytest.mark.parametrize(("distance", "called"), [(1.79, True), (1.81, False)])
def test_a_teammate_that_comes_too_near_gives_the_restart_away(new_rig, distance, called):
    rig = started(new_rig())
    stand(rig, "cyan3", distance)
    rig.tick()
    assert rig.fouls() == ([("encroachment", "cyan3")] if called else [])
    if called:
        assert (rig.state.pending.phase, rig.state.pending.side) == (Phase.FREE_KICK, MAGENTA)


def test_the_taker_and_one_robot_alone_beside_the_ball_may_be_there(new_rig):
    rig = started(new_rig())
    rig.run(1.0)
    assert rig.fouls() == []


def test_another_teammate_may_take_the_restart_in_place_of_the_first(new_rig):
    rig = started(new_rig())
    stand(rig, "cyan2", 2.5)
    rig.tick()
    stand(rig, "cyan4", 0.2)
    rig.run(0.5)
    assert rig.fouls() == []


def test_once_the_ball_is_in_play_every_robot_may_come(new_rig):
    rig = started(new_rig())
    x, y = rig.state.spot
    rig.tick((x, y), ["cyan2"], kicked="cyan2")
    rig.tick((x - 0.6, y))
    assert rig.state.phase is Phase.PLAY
    rig.events.clear()
    stand_at = (x + 1.0, y)
    rig.robots["magenta3"] = stand_at
    rig.run(0.5)
    assert rig.fouls() == []


def test_after_the_time_limit_every_robot_may_come(new_rig):
    rig = started(new_rig())
    rig.until(lambda state: state.phase is Phase.PLAY)
    rig.robots["magenta3"] = (SPOT[0] + 1.0, SPOT[1])
    rig.run(0.5)
    assert rig.fouls() == []


def too_near_at_start(rig, distance=1.0):
    """People gave START while magenta3 stood too near."""
    rig.playing()
    rig.ask("free_kick", CYAN, SPOT)
    rig.until(lambda state: state.phase is Phase.FREE_KICK)
    rig.robots["cyan2"] = (SPOT[0] - 0.4, SPOT[1])
    stand(rig, "magenta3", distance)
    rig.ask("start")
    rig.events.clear()
    return rig


@pytest.mark.parametrize(("speed", "called"), [(1.0, False), (0.85, True), (0.0, True)])
def test_a_robot_that_was_too_near_at_start_has_two_seconds_to_retreat(new_rig, speed, called):
    rig = too_near_at_start(new_rig())
    for tick in range(round(3.0 / rig.dt)):
        if not rig.state.running:
            break
        stand(rig, "magenta3", 1.0 + speed * rig.dt * tick)
        rig.tick()
    assert rig.fouls() == ([("encroachment", "magenta3")] if called else [])
    if called:
        assert "2.0 s after START" in rig.events[0].text


def test_a_robot_that_retreats_and_comes_back_encroaches(new_rig):
    rig = too_near_at_start(new_rig())
    for distance in (1.0, 1.3, 1.6, 1.41):
        stand(rig, "magenta3", distance)
        rig.tick()
    assert rig.fouls() == []
    stand(rig, "magenta3", 1.39)
    rig.tick()
    assert rig.fouls() == [("encroachment", "magenta3")]


def test_a_robot_that_was_out_once_is_no_longer_excused(new_rig):
    rig = too_near_at_start(new_rig(), 2.5)
    for distance in (2.5, 3.1, 2.7):
        stand(rig, "magenta3", distance)
        rig.tick()
    assert rig.fouls() == [("encroachment", "magenta3")]


def pushed_in(rig, pusher, behind=True):
    """magenta3 comes too near while another robot touches it, from outside or from the ball's side."""
    stand(rig, "magenta3", 2.5)
    x, y = rig.robots["magenta3"]
    rig.robots[pusher] = (x, y + (0.5 if behind else -0.5))
    return rig.tick(contacts=[("magenta3", pusher)])


@pytest.mark.parametrize(("behind", "called"), [(True, False), (False, True)])
def test_a_robot_that_an_opponent_pushes_in_has_not_encroached(new_rig, behind, called):
    rig = started(new_rig())
    stand(rig, "cyan2", 0.1, (-1.0, 0.0))
    stand(rig, "magenta3", 3.1)
    rig.tick()
    pushed_in(rig, "cyan3", behind)
    assert (("encroachment", "magenta3") in rig.fouls()) is called


def test_a_robot_that_was_pushed_in_has_to_retreat(new_rig):
    rig = started(new_rig())
    pushed_in(rig, "cyan3")
    rig.robots["cyan3"] = (-6.0, -4.0)
    rig.run(1.9)
    assert rig.fouls() == []
    rig.run(0.2)
    assert rig.fouls() == [("encroachment", "magenta3")]


def test_a_robot_that_its_teammate_pushes_in_encroaches(new_rig):
    rig = started(new_rig())
    pushed_in(rig, "magenta4")
    assert ("encroachment", "magenta3") in rig.fouls()


def test_a_robot_that_an_opponent_has_knocked_in_is_excused(new_rig):
    rig = started(new_rig())
    stand(rig, "magenta3", 3.05)
    x, y = rig.robots["magenta3"]
    rig.robots["cyan3"] = (x, y + 0.5)
    rig.tick(impacts=[("cyan3", "magenta3")], motions={"cyan3": (0.0, 0.0, -1.4)})
    stand(rig, "magenta3", 2.7)
    rig.robots["cyan3"] = (-6.0, -4.0)
    rig.run(0.4)
    assert rig.fouls() == []


@pytest.mark.parametrize(("x", "called"), [(0.21, True), (0.19, False)])
def test_at_a_kick_off_a_robot_encroaches_on_the_other_half(new_rig, x, called):
    """cyan attacks larger x; its taker may be anywhere, to play the ball backward."""
    rig = started(new_rig(), "kick_off")
    rig.robots["cyan2"] = (0.4, 0.0)
    rig.robots["cyan3"] = (x - rig.hull, 4.0)
    rig.tick()
    assert rig.fouls() == ([("encroachment", "cyan3")] if called else [])
    if called:
        assert "in the other half" in rig.events[0].text


def test_the_goalkeeper_and_one_more_defender_may_stay_near_in_their_own_penalty_area(new_rig):
    rig = new_rig()
    rig.playing()
    line = rig.pitch.goal_line
    spot = (line - 3.0, 0.0)
    rig.ask("free_kick", CYAN, spot)
    rig.until(lambda state: state.spot is not None)
    x, y = rig.state.spot
    rig.robots["cyan2"] = (x - 0.4, y)
    rig.until(lambda state: state.running)
    rig.tick()
    rig.events.clear()
    rig.robots |= {"magenta1": (line - 0.3, y), "magenta2": (line - 1.0, y)}
    rig.run(0.3)
    assert rig.fouls() == []
    rig.robots["magenta3"] = (line - 1.0, y + 0.8)
    rig.tick()
    assert [rule for rule, _ in rig.fouls()] == ["encroachment"]


def test_a_robot_off_the_field_does_not_encroach(new_rig):
    rig = started(new_rig())
    rig.ask("repair", robot="magenta3")
    assert "magenta3" in rig.state.participation.absences and rig.state.running
    rig.robots["magenta3"] = (SPOT[0] + 0.8, SPOT[1])
    rig.run(0.5)
    assert rig.fouls() == []


@pytest.mark.parametrize("phase", ["drop_ball", "penalty"])
def test_restarts_with_places_of_their_own_are_left_to_their_rules(new_rig, phase):
    rig = started(new_rig(), phase, None if phase == "drop_ball" else CYAN, taker=None)
    rig.robots["magenta3"] = (rig.ball[0] - 1.5, rig.ball[1])
    rig.tick()
    assert ("encroachment", "magenta3") not in rig.fouls()


def test_a_friendly_does_not_call_it(new_rig):
    rig = started(new_rig(rules="friendly"))
    stand(rig, "magenta3", 0.6)
    rig.tick()
    assert rig.fouls() == []
