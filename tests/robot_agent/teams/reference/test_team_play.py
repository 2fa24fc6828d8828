"""The whole team on the pitch: who goes for the ball, set pieces, no radio."""

import math

import pytest

from robot_agent.sdk.contract import Briefing
from robot_agent.teams.action import Action
from robot_agent.teams.reference import Reference
from robot_agent.teams.reference.parameters import PARAMETERS
from schemas.messages.command import Drive
from schemas.messages.sight import BallSight, Motion, ReceivedRadio

FIELD = {"cyan1": (-10.5, 0, 0), "cyan2": (-2, 2, 0), "cyan3": (-2, -2, 0), "cyan4": (-5, 1, 0), "cyan5": (-5, -2, 0)}
THEIRS = {"magenta1": (10.5, 0, math.pi), "magenta2": (5.0, 5.0, math.pi), "magenta3": (-5.0, 4.0, math.pi)}


def away(world, robot):
    ball, place = world["ball"], world["robots"][robot]
    return math.hypot(place["x"] - ball["x"], place["y"] - ball["y"])


def roles(played):
    """The role that each robot sent last."""
    sent = {}
    for commands in played.commands:
        sent.update({name: one.radio.role for name, one in commands.items() if one.radio is not None})
    return sent


@pytest.mark.parametrize("ball", [(-1.0, 0.0), (-4.0, -3.0)])
def test_one_robot_goes_for_the_ball_and_the_others_stay_off_it(scene, ball):
    played = scene(FIELD | THEIRS, ball).play(0.8)
    assert list(roles(played).values()).count("attacker") == 1
    field = [name for name in FIELD if name != "cyan1"]
    for tick in played.ticks:
        assert sum(away(tick.world, name) < 1.0 for name in field) <= 1


@pytest.mark.parametrize("phase", ["throw_in", "free_kick", "corner", "kick_off"])
def test_at_their_set_piece_every_robot_keeps_the_distance(scene, phase):
    ball = {"throw_in": (-3.0, -7.0), "free_kick": (-2.0, 0.0), "corner": (-10.7, 6.7), "kick_off": (0.0, 0.0)}
    played = scene(FIELD | THEIRS, ball[phase], phase, "magenta").play(4.5)
    world = played.ticks[-1].world
    hull = 0.245
    for name in FIELD:
        assert away(world, name) - hull >= 3.0 or name == "cyan1"


def test_at_their_throw_in_the_free_opponent_is_marked(scene):
    robots = FIELD | THEIRS | {"magenta4": (-7.0, -1.0, 0.0)}
    played = scene(robots, (-5.0, -6.9), "throw_in", "magenta").play(4.5)
    world = played.ticks[-1].world["robots"]
    marked = world["magenta4"]
    assert min(math.hypot(world[name]["x"] - marked["x"], world[name]["y"] - marked["y"]) for name in FIELD) < 1.8


def test_the_own_throw_in_goes_to_a_teammate(scene):
    played = scene(FIELD | THEIRS, (-1.0, 6.9), "throw_in", "cyan")
    played.play(9.0, lambda played: any(one.radio and one.radio.pass_to for one in played.kicks(_taker(played))))
    assert len(played.kicks(_taker(played))) == 1


def _taker(played):
    taking = (name for name, role in roles(played).items() if role == "attacker")
    return next(taking, "cyan2")


def test_without_radio_one_robot_still_gets_the_ball_and_others_stay_off_it(scene):
    """The ball is in the part of cyan3; cyan2 is nearer to it."""
    played = scene(FIELD | THEIRS, (-0.5, 3.0), radio={"loss": 1.0})
    played.play(4.0, lambda played: played.match.simulation.now.world["possession"] is not None)
    assert played.match.simulation.now.world["possession"] == "cyan3"
    field = [name for name in FIELD if name != "cyan1"]
    for tick in played.ticks:
        assert sum(away(tick.world, name) < 1.0 for name in field) <= 1


@pytest.mark.parametrize("drill", ["keeper_lobs", "keeper_ground_shots"])
def test_the_keeper_stops_lobs_and_shots_along_the_ground(play, drill):
    runs = play.over(drill, seeds=range(1, 5), cyan1="robot_agent.teams.reference:Reference")
    runs.at_least(3, lambda facts: facts.success)


def test_before_the_own_kick_off_everyone_is_in_the_own_half_and_the_ball_goes_to_a_teammate(scene):
    played = scene(FIELD | THEIRS, (0.0, 0.0), "kick_off", "cyan")
    played.play(7.0, lambda played: played.match.simulation.state.running)
    world = played.ticks[-1].world["robots"]
    assert all(world[name]["x"] < 0.3 for name in FIELD)
    played.play(6.0, lambda played: played.match.simulation.state.phase == "play")
    assert played.match.simulation.state.phase == "play"
    assert sum(len(played.kicks(name)) for name in FIELD) == 1


def test_every_robot_draws_its_role_and_the_holder_what_it_weighed(scene):
    played = scene(FIELD | THEIRS, (-1.4, 2.0)).play(1.2)
    drawn = {name: one.debug for commands in played.commands for name, one in commands.items() if one.debug is not None}
    assert {drawn[name].values["role"] for name in FIELD} >= {"keeper", "attacker", "guard"}
    assert all(drawn[name].texts[0].text.startswith(str(drawn[name].values["role"])) for name in FIELD)
    weighed = [one["cyan2"].debug.values for one in played.commands if one["cyan2"].debug is not None]
    assert any({"shot", "pass", "dribble"} <= values.keys() for values in weighed)


@pytest.mark.parametrize(("mate", "holds"), [((1.05, 0.0), True), ((-6.0, 3.0), False)])
def test_a_teammate_holds_the_ball_by_its_words_if_it_is_at_the_ball(setup, sight_of, mate, holds):
    """The robot that is nearer to the ball leaves it to a teammate that has it, and to no other."""
    robot = Reference(Briefing.of("cyan2", setup))
    said = ReceivedRadio(age=0.0, self=Motion(x=mate[0], y=mate[1], heading=0.0), extra={"arrival": -1.0})
    sights = (
        sight_of(tick, ball=BallSight(x=0.5, y=0.0, vx=0.0, vy=0.0), radio={"cyan3": said}) for tick in range(1, 12)
    )
    sent = [command.radio.role for command in map(robot.act, sights) if command.radio is not None]
    assert sent
    assert (sent[-1] == "attacker") is not holds


class Backward(Reference):
    """A robot that wants to drive backward."""

    def play(self, belief, order):
        return Action("attacker", "back", Drive(vx=-2.0))


@pytest.mark.parametrize(("ball", "opponent", "brakes"), [(0.4, -0.55, True), (-0.4, -0.8, False), (-0.4, 0.6, False)])
def test_beside_the_ball_a_robot_brakes_before_an_opponent_that_is_not_beyond_it(
    setup, sight_of, ball, opponent, brakes
):
    robot = Backward(Briefing.of("cyan2", setup))
    command = robot.act(sight_of(1, velocity=(-2.0, 0.0, 0.0), ball=(ball, 0.0), obstacles=((opponent, 0.0),)))
    assert command.drive.vx == (pytest.approx(-PARAMETERS.bump) if brakes else -2.0)
