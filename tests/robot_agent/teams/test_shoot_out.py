"""What the shipped teams do in a penalty shoot-out, and with robots off the field."""

import math

import pytest

from schemas.messages.command import Drive
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.soccer.game import GameStage, OffField, TeamPhase

MARK = {"x": 7.4, "y": 0.0}
SHOOT_OUT = {"stage": GameStage.SHOOT_OUT}
TEAMS = pytest.mark.parametrize("team", ["simple", "nubot"])


def driven(squad, seconds, **seen):
    for _ in range(round(seconds * 50)):
        squad.move(squad.act(**seen))


@TEAMS
def test_before_start_the_kicker_waits_in_the_centre_circle_and_the_others_beyond_halfway(squad, team):
    players = squad(team)
    driven(players, 8.0, ball=(7.4, 0.0), phase=TeamPhase.OUR_PENALTY, running=False, spot=MARK, game=SHOOT_OUT)
    places = {name: pose[:2] for name, pose in players.poses.items()}
    assert math.hypot(*places["cyan2"]) < players.setup.pitch.centre_circle_radius
    for name in ("cyan3", "cyan4", "cyan5"):
        assert places[name][0] < -players.setup.robot.reach
        assert math.hypot(*places[name]) - players.setup.robot.reach > players.setup.pitch.centre_circle_radius


@TEAMS
def test_the_kicker_kicks_once(squad, team):
    players = squad(team, {1: (-10.5, 0.0, 0.0), 2: (7.0, 0.0, 0.23)})
    seen = {"ball": (7.35, 0.08), "phase": TeamPhase.OUR_PENALTY, "spot": MARK, "game": SHOOT_OUT, "holding": True}
    kicks = 0
    for _ in range(150):
        commands = players.act(opponents=[(10.7, -0.3)], **seen)
        players.move(commands)
        kicks += commands["cyan2"].kick is not None
    assert kicks == 1


@TEAMS
def test_a_goalkeeper_in_the_middle_of_its_goal_does_not_make_the_kicker_change_its_mind(squad, team):
    """Seen now on this side of the middle, now on that, by the noise of the cameras."""
    players, turns = squad(team, {1: (-10.5, 0.0, 0.0), 2: (7.0, 0.0, 0.02)}), []
    seen = {"ball": (7.35, 0.0), "phase": TeamPhase.OUR_PENALTY, "spot": MARK, "game": SHOOT_OUT, "holding": True}
    for tick in range(60):
        commands = players.act(opponents=[(10.7, 0.06 if tick // 4 % 2 else -0.06)], **seen)
        turns.append(commands["cyan2"].drive.omega)
    assert min(turns) > 0.0


@TEAMS
@pytest.mark.parametrize("keeper", [-0.5, 0.5])
def test_a_penalty_is_aimed_past_a_goalkeeper_that_has_left_the_middle(squad, team, keeper):
    players = squad(team, {1: (-10.5, 0.0, 0.0), 2: (7.0, 0.0, math.copysign(0.02, keeper))})
    seen = {"ball": (7.35, 0.0), "phase": TeamPhase.OUR_PENALTY, "spot": MARK, "game": SHOOT_OUT, "holding": True}
    commands = players.act(opponents=[(10.7, keeper)], **seen)
    assert commands["cyan2"].drive.omega * keeper < 0.0


@TEAMS
def test_the_next_on_the_field_takes_it_when_the_first_is_off(squad, team):
    players = squad(team)
    game = SHOOT_OUT | {"robots": {"cyan2": DisciplinaryRecord(red=1, off_field=OffField.RED_CARD)}}
    driven(players, 8.0, ball=(7.4, 0.0), phase=TeamPhase.OUR_PENALTY, running=False, spot=MARK, game=game)
    assert math.hypot(*players.poses["cyan3"][:2]) < players.setup.pitch.centre_circle_radius


@TEAMS
def test_a_robot_off_the_field_rests_and_the_others_play_without_it(squad, team):
    """The one nearest to the ball is off: another goes for it."""
    players = squad(team)
    seen = {"ball": (-1.5, 1.0), "game": {"robots": {"cyan2": DisciplinaryRecord(off_field=OffField.REPAIR, left=9.0)}}}
    for _ in range(60):
        commands = players.act(**seen)
        assert commands["cyan2"].drive == Drive()
        players.move(commands)
    assert math.dist(players.poses["cyan3"][:2], (-1.5, 1.0)) < 1.0
