"""Test mode in single decisions; what comes of it in the simulated world, `tests/match/test_coach_tests.py` shows."""

import pytest

from robot_agent.teams.coach_tests import LEAVES
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.command import Drive
from schemas.soccer.game import Point, TeamPhase

TEAMS = ("simple", "nubot")
STARTS = {1: (-10.5, 0.0, 0.0), 2: (2.0, 1.0, 0.0), 3: (-2.0, -1.0, 0.0)}


def order(test: CoachTest, sequence: int = 7, **content: object) -> CoachOrder:
    return CoachOrder(sequence=sequence, mode=CoachMode.TEST, test=test, **content)


SHOOT = order(CoachTest.SHOOT, robot_a="cyan2")


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("test", [CoachTest.MOVE, CoachTest.CIRCLE, CoachTest.SHOOT, CoachTest.CATCH])
def test_a_robot_that_the_order_does_not_name_stands_still_and_acknowledges(squad, team, test):
    made = squad(team, STARTS)
    given = order(test, robot_a="cyan2", point_a=Point(x=5.0, y=3.0), radius=1.0)
    for _ in range(20):
        commands = made.act(ball=(4.0, 2.0), order=given)
        assert [commands[name].drive for name in ("cyan1", "cyan3")] == [Drive(), Drive()]
        assert all(command.acknowledges_order == 7 for command in commands.values())
    assert commands["cyan2"].drive != Drive()


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("test", list(CoachTest))
def test_a_test_that_a_team_does_not_know_is_refused_by_its_name(squad, team, test):
    """Only NuBot's robots have the paper's behaviour machine."""
    made = squad(team, STARTS)
    places = {"point_a": Point(x=5.0, y=3.0), "point_b": Point(x=2.0, y=3.0)}
    given = order(test, robot_a="cyan2", robot_b="cyan3", radius=1.0, **places)
    unknown = test is CoachTest.MACHINE and team == "simple"
    for _ in range(7):  # some answers repeat the one before
        commands = made.act(ball=(4.0, 2.0), order=given)
        refusals = {command.refuses_order for command in commands.values()}
        assert refusals == {"unknown test: machine" if unknown else ""}


@pytest.mark.parametrize("team", TEAMS)
def test_a_tactic_that_a_team_does_not_know_is_refused_by_its_name(squad, team):
    made = squad(team, STARTS)
    for _ in range(7):
        commands = made.act(ball=(-9.0, 5.0), order=CoachOrder(sequence=3, tactic="all " * 20))
        assert {command.refuses_order for command in commands.values()} == {f"unknown tactic: {'all ' * 16}"}
    assert made.act(order=CoachOrder(sequence=4))["cyan1"].refuses_order == ""


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", [TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.FULL_TIME])
def test_in_a_pause_no_test_is_shown(squad, team, phase):
    commands = squad(team, STARTS).act(ball=(4.0, 2.0), phase=phase, running=False, order=SHOOT)
    assert all(command.drive == Drive() and command.kick is None for command in commands.values())


@pytest.mark.parametrize("team", TEAMS)
def test_one_order_is_one_kick_and_another_order_is_another(squad, team):
    made = squad(team, {**STARTS, 2: (2.0, 0.0, 0.0)})
    made.act(ball=(2.35, 0.0), order=SHOOT)
    kicks = [made.act(ball=(2.35, 0.0), holding=True, order=SHOOT)["cyan2"].kick]
    kicks += [made.act(ball=(6.0, 0.0), holding=False, order=SHOOT)["cyan2"].kick for _ in range(50)]
    assert [kick is not None for kick in kicks] == [True] + 50 * [False]
    again = order(CoachTest.SHOOT, sequence=8, robot_a="cyan2")
    made.act(ball=(2.35, 0.0), order=again)
    assert made.act(ball=(2.35, 0.0), holding=True, order=again)["cyan2"].kick is not None


@pytest.mark.parametrize("team", TEAMS)
def test_a_kick_that_was_refused_is_tried_again(squad, team):
    """The ball is still there half a second later."""
    made = squad(team, {**STARTS, 2: (2.0, 0.0, 0.0)})
    kicks = [made.act(ball=(2.35, 0.0), holding=True, order=SHOOT)["cyan2"].kick for _ in range(100)]
    places = [place for place, kick in enumerate(kicks) if kick is not None]
    assert len(places) > 1
    assert (places[1] - places[0]) * 0.02 == pytest.approx(LEAVES, abs=0.05)


@pytest.mark.parametrize("team", TEAMS)
def test_a_robot_without_a_charged_kicker_does_not_count_as_having_kicked(squad, team):
    made = squad(team, {**STARTS, 2: (2.0, 0.0, 0.0)})
    for _ in range(10):
        assert made.act(ball=(2.35, 0.0), holding=True, kicker_ready=False, order=SHOOT)["cyan2"].kick is None
    assert made.act(ball=(2.35, 0.0), holding=True, order=SHOOT)["cyan2"].kick is not None


@pytest.mark.parametrize("team", TEAMS)
def test_a_ball_that_is_not_seen_is_looked_for(squad, team):
    made = squad(team, STARTS)
    for _ in range(200):
        commands = made.act(ball=None, order=SHOOT)
    assert commands["cyan2"].drive != Drive() and commands["cyan3"].drive == Drive()
