"""Parameters by name: what may be changed is what a profile may hold, and it can all be brought back."""

from dataclasses import fields

import pytest

from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.config.sections import SECTIONS
from schemas.errors import TouchlineError
from schemas.messages.parameters import ParameterOperation, ParametersRequest
from sim_host.match.live_parameters import PRESET, LiveParameters


@pytest.fixture
def live_parameters() -> LiveParameters:
    return LiveParameters.of(MatchConfig())


def test_every_number_of_the_profile_is_listed_with_unit_range_origin_and_value(
    live_parameters: LiveParameters,
) -> None:
    listed = {parameter.name: parameter for parameter in live_parameters.describe()}
    everything = [f"{section}.{field.name}" for section, cls in SECTIONS.items() for field in fields(cls)]
    assert set(everything) <= set(listed) and PRESET in listed
    rolling = listed["ball.rolling_deceleration"]
    assert (rolling.unit, rolling.low, rolling.high) == ("m/s²", 0, 10)
    assert rolling.value == rolling.initial == load_profile("msl").ball.rolling_deceleration
    assert rolling.origin == load_profile("msl").origins["ball.rolling_deceleration"]
    assert rolling.live and not rolling.fixed_reason


def test_time_steps_and_sizes_can_be_read_and_not_changed(live_parameters: LiveParameters) -> None:
    fixed = {parameter.name: parameter.fixed_reason for parameter in live_parameters.describe() if not parameter.live}
    assert {"time.physics_step", "field.length", "robot.radius", "ball.radius"} <= set(fixed)
    assert all(fixed.values())
    with pytest.raises(TouchlineError, match=r"field\.length cannot be changed; sizes are fixed"):
        live_parameters.with_values({"field.length": 18.0})


WRONG = {
    "an unknown section": ({"bal.mass": 0.4}, 'bal.mass is not a parameter; did you mean "ball"'),
    "an unknown number": ({"ball.mas": 0.4}, 'did you mean "ball.mass"'),
    "a number out of range": ({"radio.loss": 1.5}, "radio.loss is 1.5; it must be between 0 and 1"),
    "a word for a number": ({"radio.loss": "much"}, "radio.loss is 'much'; write a number"),
    "a word that is not known": ({"dribble.method": "glue"}, "dribble.method is 'glue'"),
    "an unknown noise": ({PRESET: "perfct"}, 'did you mean "perfect"'),
    "two that do not fit": ({"dribble.gap": 0.5}, "dribble.gap is 0.5 m; a held ball must stay within"),
    "nothing": ({}, "no value is given"),
}


@pytest.mark.parametrize("values, said", WRONG.values(), ids=WRONG)
def test_a_wrong_value_is_refused_with_what_is_wrong(live_parameters: LiveParameters, values, said) -> None:
    with pytest.raises(TouchlineError, match=said):
        live_parameters.with_values(values)


def test_numbers_that_fit_only_together_are_set_together(live_parameters: LiveParameters) -> None:
    both = live_parameters.with_values({"dribble.gap": 0.5, "dribble.distance": 0.55})
    assert (both.profile.dribble.gap, both.profile.dribble.distance) == (0.5, 0.55)


def test_a_number_of_the_noise_that_is_not_in_use_is_refused(live_parameters: LiveParameters) -> None:
    perfect = live_parameters.with_values({PRESET: "perfect"})
    with pytest.raises(TouchlineError, match=r'no effect while noise\.preset is "perfect"'):
        perfect.with_values({"sensing.ball_velocity": 0.2})
    together = perfect.with_values({PRESET: "profile", "sensing.ball_velocity": 0.2})
    assert together.sensing.ball_velocity == 0.2


def test_reset_brings_back_what_is_named_a_section_or_everything(live_parameters: LiveParameters) -> None:
    changed = live_parameters.with_values({"ball.mass": 0.3, "radio.loss": 0.5, PRESET: "perfect"})
    assert set(changed.changes_since(live_parameters)) == {"ball.mass", "radio.loss", PRESET}

    def reset(*names: str) -> set[str]:
        request = ParametersRequest(operation=ParameterOperation.RESET, names=list(names))
        return set(changed.after_request(request).changes_since(live_parameters))

    assert reset("radio.loss") == {"ball.mass", PRESET}
    assert reset("ball", "noise") == {"radio.loss"}
    assert reset() == set()
    with pytest.raises(TouchlineError, match=r"time\.physics_step cannot be changed"):
        reset("time.physics_step")


def test_the_radio_numbers_of_the_match_file_are_the_start_values() -> None:
    live_parameters = LiveParameters.of(MatchConfig.model_validate({"radio": {"loss": 0.25}}))
    (loss,) = live_parameters.describe(["radio.loss"])
    assert (loss.value, loss.initial, loss.origin) == (0.25, 0.25, "the match file")


def test_what_was_noted_of_a_change_makes_the_same_change_again(live_parameters: LiveParameters) -> None:
    changed = live_parameters.with_values({"drive.max_speed": 2.0, PRESET: "paper"})
    assert live_parameters.with_settings(changed.changes_since(live_parameters)) == changed


def test_the_numbers_of_a_type_of_robots_are_parameters_of_their_own(live_parameters: LiveParameters) -> None:
    (slow,) = live_parameters.describe(["types.slow.drive.max_speed"])
    assert (slow.value, slow.unit, slow.live) == (2.0, "m/s", True)
    assert slow.origin == live_parameters.initial.origins["types.slow.drive.max_speed"]
    changed = live_parameters.with_values({"types.slow.drive.max_speed": 1.0})
    assert (changed.types["slow"].drive.max_speed, changed.profile.drive.max_speed) == (1.0, 4.0)
    with pytest.raises(TouchlineError, match=r"types\.keeper\.robot\.frame_width cannot be changed"):
        live_parameters.with_values({"types.keeper.robot.frame_width": 0.5})
    with pytest.raises(TouchlineError, match=r"types\.slwo"):
        live_parameters.describe(["types.slwo.drive.max_speed"])


def test_what_a_type_does_not_change_follows_the_standard_robot_again_after_a_reset(
    live_parameters: LiveParameters,
) -> None:
    own = live_parameters.with_values({"types.slow.kicker.max_ground_speed": 3.0})
    assert own.changes_since(live_parameters) == {"types.slow.kicker.max_ground_speed": 3.0}
    back = own.after_request(ParametersRequest(operation=ParameterOperation.RESET, names=["types.slow"]))
    assert back.changes_since(own) == {"types.slow.kicker.max_ground_speed": None}
    assert back == live_parameters
    assert back.with_values({"kicker.max_ground_speed": 8.0}).types["slow"].kicker.max_ground_speed == 8.0
    assert own.with_settings(back.changes_since(own)) == back


def test_a_list_leaves_out_what_a_type_has_from_the_standard_robot(live_parameters: LiveParameters) -> None:
    listed = {parameter.name for parameter in live_parameters.describe()}
    assert "types.slow.drive.max_speed" in listed and "types.slow.kicker.max_ground_speed" not in listed
