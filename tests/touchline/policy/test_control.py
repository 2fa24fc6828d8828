"""What an action does: numbers from −1 to 1 become a command within the robot's limits."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from schemas.errors import TouchlineError
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


def test_the_parameters_of_a_team_choose_the_entries_and_the_others_are_zero(keepers: InProcessMatch) -> None:
    briefing = Briefing.of("cyan1", keepers.simulation.setup())
    sight = keepers.simulation.now.sights.perceived["cyan1"].replace(holding=True)
    control = Control(replace(briefing, parameters={"act": "kick vy"}))
    assert control.names == ["vy", "kick"]
    made = control.command(np.array([0.5, 1.0], np.float32), sight.tick, can_kick=True)
    whole = commanded(keepers, "cyan1", [0.0, 0.5, 0.0, 1.0, 0.0, 0.0], is_new=False, holding=True)
    assert made == whole and made.kick is not None
    assert control.action(made).tolist() == [0.5, 1.0]
    with pytest.raises(TouchlineError, match='parameter act names "vz"; known: vx'):
        Control(replace(briefing, parameters={"act": "vz"}))


def test_a_robot_without_any_entry_is_one_clear_error(rovers: InProcessMatch) -> None:
    briefing = replace(Briefing.of("one", rovers.simulation.setup()), parameters={"act": "vy kick"})
    with pytest.raises(TouchlineError, match="parameter act leaves one no action; name some of vx, omega"):
        Control(briefing)


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


def test_a_correction_changes_velocities_and_overrules_the_brain_beyond_a_half(keepers: InProcessMatch) -> None:
    setup = keepers.simulation.setup()
    top, sight = setup.drive.max_speed, keepers.simulation.now.sights.perceived["cyan1"]
    control = Control(Briefing.of("cyan1", setup))
    lob = Kick(mode=KickMode.LOB, speed=4.0)
    brain = Command(answers_tick=sight.tick, drive=Drive(vx=0.5 * top, vy=1.5 * top, omega=-0.0), kick=lob)

    def corrected(action: list[float], brain: Command = brain, can_kick: bool = True) -> Command:
        radio = control.message(sight)
        numbers = np.array(action, np.float32)
        return control.command(numbers, sight.tick, can_kick=can_kick, radio=radio, corrected=brain)

    assert corrected([0.0] * 6).encode() == brain.encode()
    changed = corrected([0.25, 1.0, 0.5, 0.0, 0.2, 0.6])
    assert changed.drive == Drive(vx=0.75 * top, vy=1.5 * top, omega=0.5 * setup.drive.max_turn_rate)
    assert changed.kick is not None and changed.kick.mode is KickMode.LOB and changed.dribble
    assert changed.kick.speed == pytest.approx(4.0 + 0.2 * setup.kicker.max_ground_speed)
    assert corrected([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]).drive.vx == -0.5 * top
    assert corrected([0.0, 0.0, 0.0, -0.6, 0.0, 0.0]).kick is None
    assert corrected([0.0, 0.0, 0.0, 0.0, -0.5, 0.0]).kick is None
    assert not corrected([0.0] * 5 + [-0.6], brain.replace(dribble=True)).dribble
    still = Command(answers_tick=sight.tick)
    assert corrected([0.0, 0.0, 0.0, 0.5, 0.0, 0.5], still) == still
    assert corrected([0.0, 0.0, 0.0, 0.6, 0.0, 0.0], still, can_kick=False) == still
    own = corrected([0.0, 0.0, 0.0, 0.6, -0.25, 0.0], still).kick
    assert own == Kick(mode=KickMode.GROUND, speed=0.75 * setup.kicker.max_ground_speed)


def test_the_action_of_a_command_beyond_the_limits_is_cut_off_and_knows_no_lob(keepers: InProcessMatch) -> None:
    control = Control(Briefing.of("cyan1", keepers.simulation.setup()))
    lob = Kick(mode=KickMode.LOB, speed=0.25 * keepers.simulation.setup().kicker.max_ground_speed)
    command = Command(answers_tick=0, drive=Drive(vx=20.0, omega=-50.0), kick=lob)
    assert control.action(command).tolist() == pytest.approx([1.0, 0.0, -1.0, 1.0, -0.5, -1.0])
