"""What `play` of a team returns is checked where it returns, and the sentence names the team's file and line."""

import pytest

from robot_agent.loading.brain_error import BrainError
from robot_agent.loading.user_code import ReturnedError, is_users
from robot_agent.sdk.contract import Briefing
from robot_agent.teams import player
from robot_agent.teams.action import Action
from robot_agent.teams.player import Player
from robot_agent.teams.simple import team
from schemas.messages.command import Drive
from schemas.messages.setup import Setup
from schemas.soccer.game import TeamPhase

WRONG = [
    (None, "play returned None{place}; return an Action"),
    ("attacker", "play returned 'attacker'{place}; return an Action"),
    (("attacker", "get the ball", Drive()), "{place}; return an Action"),
    (Action("", "", None), "play returned an Action with drive None{place}; give a Drive"),
    (Action("", "", Drive(), kick=8.0), "play returned an Action with kick 8.0{place}; give a Kick or None"),
    (Action("", 3, Drive()), "play returned an Action with intention 3{place}; give text of at most 80 characters"),
    (Action("a" * 81, "", Drive()), "{place}; give text of at most 80 characters"),
]


@pytest.mark.parametrize(("returned", "sentence"), WRONG, ids=lambda value: str(value)[:20])
def test_what_play_returns_in_place_of_an_action_is_named_with_the_line_of_play(
    setup: Setup, sight_of, returned, sentence
) -> None:
    class Team(Player):
        def play(self, belief, order):
            return returned

    place = f" (tests/robot_agent/teams/test_action.py, line {Team.play.__code__.co_firstlineno})"
    brain = Team(Briefing.of("cyan2", setup))
    with pytest.raises(ReturnedError) as raised:
        brain.act(sight_of(3, "cyan2", (0.0, 0.0, 0.0), ball=(1.0, 0.0), phase=TeamPhase.PLAY))
    assert sentence.format(place=place) in str(raised.value)
    error = BrainError(3, brain.act)
    error.__cause__ = raised.value
    assert error.report() == f"act failed at tick 3: {raised.value}\n"


def test_what_all_teams_have_in_common_is_no_users_code_and_a_team_that_ships_is() -> None:
    assert (is_users(player.__file__), is_users(team.__file__)) == (False, True)
