"""What an action does: numbers from −1 to 1 become a command within the robot's limits."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.soccer.game import OffField
from touchline.play.play_match import InProcessMatch
from touchline.policy.control import Control
from touchline.policy.observation import Observation
from touchline.policy.policy_brain import PolicyBrain


class Steady:
    """A policy with one action for everything."""

    def __init__(self, action: list[float], observations: int) -> None:
        self._action, self.actions, self.observations = np.array(action, np.float32), len(action), observations

    def action(self, _observation: NDArray[np.float32]) -> NDArray[np.float32]:
        return self._action


def commanded(
    match: InProcessMatch, robot: str, action: list[float], *, is_new: bool = True, **changes: Any
) -> Command:
    """The command for an action that a policy takes at this sight, or took at it before; `changes` are of the sight."""
    sight: Sight = match.simulation.now.sights.perceived[robot].replace(**changes)
    briefing = Briefing.of(robot, match.simulation.setup())
    brain = PolicyBrain(briefing, Steady(action, len(Observation(briefing).entries)))
    first = brain.act(sight)
    return first if is_new else brain.act(sight)


def test_full_speed_is_that_of_the_robot(keepers: InProcessMatch, rovers: InProcessMatch) -> None:
    drive = keepers.simulation.setup().drive
    command = commanded(keepers, "cyan1", [1.0, -0.5, 0.25, -1.0, 0.0, -1.0])
    assert command.drive == Drive(vx=drive.max_speed, vy=-0.5 * drive.max_speed, omega=0.25 * drive.max_turn_rate)
    two_wheels = commanded(rovers, "one", [0.5, 0.5])
    limits = rovers.simulation.setup().drive
    assert two_wheels.drive == Drive(vx=0.5 * limits.max_speed, omega=0.5 * limits.max_turn_rate)
    assert (two_wheels.kick, two_wheels.dribble) == (None, False)


def test_numbers_beyond_one_are_cut_off(keepers: InProcessMatch) -> None:
    three = [0.0, 0.0, 0.0]
    assert commanded(keepers, "cyan1", [7.0, -7.0, 7.0, *three]) == commanded(
        keepers, "cyan1", [1.0, -1.0, 1.0, *three]
    )


def test_a_robot_kicks_once_it_holds_the_ball_and_its_kicker_is_charged(keepers: InProcessMatch) -> None:
    action = [0.0, 0.0, 0.0, 0.1, 0.0, 1.0]
    assert commanded(keepers, "cyan1", action, holding=False).kick is None
    assert commanded(keepers, "cyan1", action, holding=True, kicker_ready=False).kick is None
    assert commanded(keepers, "cyan1", [0.0, 0.0, 0.0, 0.0, 1.0, 1.0], holding=True).kick is None
    assert commanded(keepers, "cyan1", [0.0, 0.0, 0.0, 1.0, -1.0, 1.0], holding=True).kick is None
    command = commanded(keepers, "cyan1", action, holding=True)
    assert command.kick is not None and command.kick.mode is KickMode.GROUND
    assert command.kick.speed == pytest.approx(0.5 * keepers.simulation.setup().kicker.max_ground_speed)
    assert command.dribble


def test_with_each_decision_the_team_hears_where_the_robot_and_the_ball_are(keepers: InProcessMatch) -> None:
    now = keepers.simulation.now.sights.perceived["cyan1"]
    told = commanded(keepers, "cyan1", [0.0] * 6).radio
    assert told is not None and told.self == now.self and told.ball is not None and told.ball.x == now.ball.x
    assert commanded(keepers, "cyan1", [0.0] * 6, is_new=False).radio is None
    blind = commanded(keepers, "cyan1", [0.0] * 6, ball=None).radio
    assert blind is not None and blind.ball is None


def test_a_robot_that_is_off_the_field_does_nothing(keepers: InProcessMatch) -> None:
    game = keepers.simulation.now.sights.perceived["cyan1"].game
    off = game.replace(robots={"cyan1": DisciplinaryRecord(off_field=OffField.RED_CARD)})
    assert commanded(keepers, "cyan1", [1.0] * 6, game=off, holding=True) == Command(answers_tick=0)
    assert commanded(keepers, "cyan2", [1.0] * 6, game=off) != Command(answers_tick=0)


def test_the_action_of_a_command_gives_the_command_again(keepers: InProcessMatch, rovers: InProcessMatch) -> None:
    for match, robot, action in (
        (keepers, "cyan1", [0.5, -0.25, 0.125, 1.0, 0.5, 1.0]),
        (keepers, "cyan1", [-0.5, 1.0, -1.0, -1.0, 0.0, -1.0]),
        (rovers, "one", [0.5, -0.5]),
    ):
        control = Control(Briefing.of(robot, match.simulation.setup()))
        assert control.action(commanded(match, robot, action, holding=True)).tolist() == pytest.approx(action)


def test_the_action_of_a_command_beyond_the_limits_is_cut_off_and_knows_no_lob(keepers: InProcessMatch) -> None:
    control = Control(Briefing.of("cyan1", keepers.simulation.setup()))
    lob = Kick(mode=KickMode.LOB, speed=0.25 * keepers.simulation.setup().kicker.max_ground_speed)
    command = Command(answers_tick=0, drive=Drive(vx=20.0, omega=-50.0), kick=lob)
    assert control.action(command).tolist() == pytest.approx([1.0, 0.0, -1.0, 1.0, -0.5, -1.0])
