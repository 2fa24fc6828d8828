"""Parameters by name: what may be changed is what a profile may hold, and it can all be brought back."""

from dataclasses import fields

import pytest

from schemas.errors import TouchlineError
from schemas.match_config import MatchConfig
from schemas.parameters import ParameterDeed, ParametersRequest
from schemas.profile import load_profile
from schemas.sections import SECTIONS
from sim_host.tuning import PRESET, Tuning


@pytest.fixture
def tuning() -> Tuning:
    return Tuning.of(MatchConfig())


def test_every_number_of_the_profile_is_listed_with_unit_range_origin_and_value(tuning: Tuning) -> None:
    listed = {parameter.name: parameter for parameter in tuning.describe()}
    everything = [f"{section}.{field.name}" for section, cls in SECTIONS.items() for field in fields(cls)]
    assert set(everything) <= set(listed) and PRESET in listed
    rolling = listed["ball.rolling_deceleration"]
    assert (rolling.unit, rolling.low, rolling.high) == ("m/s²", 0, 10)
    assert rolling.value == rolling.initial == load_profile("msl").ball.rolling_deceleration
    assert rolling.origin == load_profile("msl").origins["ball.rolling_deceleration"]
    assert rolling.live and not rolling.why_not


def test_time_steps_and_sizes_can_be_read_and_not_changed(tuning: Tuning) -> None:
    fixed = {parameter.name: parameter.why_not for parameter in tuning.describe() if not parameter.live}
    assert {"time.physics_step", "field.length", "robot.radius", "ball.radius"} <= set(fixed)
    assert all(fixed.values())
    with pytest.raises(TouchlineError, match=r"field\.length cannot be changed; sizes are fixed"):
        tuning.with_values({"field.length": 18.0})


WRONG = {
    "an unknown section": ({"bal.mass": 0.4}, 'bal.mass is no parameter; did you mean "ball"'),
    "an unknown number": ({"ball.mas": 0.4}, 'did you mean "ball.mass"'),
    "a number out of range": ({"radio.loss": 1.5}, "radio.loss is 1.5; it lies between 0 and 1"),
    "a word for a number": ({"radio.loss": "much"}, "radio.loss is 'much'; write a number"),
    "a word that is not known": ({"dribble.method": "glue"}, "dribble.method is 'glue'"),
    "an unknown noise": ({PRESET: "perfct"}, 'did you mean "perfect"'),
    "two that do not fit": ({"dribble.gap": 0.5}, "dribble.gap is 0.5 m; a held ball must stay within"),
    "nothing": ({}, "no value is given"),
}


@pytest.mark.parametrize("values, said", WRONG.values(), ids=WRONG)
def test_a_wrong_value_is_refused_with_what_is_wrong(tuning: Tuning, values, said) -> None:
    with pytest.raises(TouchlineError, match=said):
        tuning.with_values(values)


def test_numbers_that_fit_only_together_are_set_together(tuning: Tuning) -> None:
    both = tuning.with_values({"dribble.gap": 0.5, "dribble.distance": 0.55})
    assert (both.profile.dribble.gap, both.profile.dribble.distance) == (0.5, 0.55)


def test_a_number_of_the_noise_that_is_not_in_use_is_refused(tuning: Tuning) -> None:
    perfect = tuning.with_values({PRESET: "perfect"})
    with pytest.raises(TouchlineError, match=r'no effect while noise\.preset is "perfect"'):
        perfect.with_values({"sensing.ball_velocity": 0.2})
    together = perfect.with_values({PRESET: "profile", "sensing.ball_velocity": 0.2})
    assert together.sensing.ball_velocity == 0.2


def test_reset_brings_back_what_is_named_a_section_or_everything(tuning: Tuning) -> None:
    changed = tuning.with_values({"ball.mass": 0.3, "radio.loss": 0.5, PRESET: "perfect"})
    assert set(changed.since(tuning)) == {"ball.mass", "radio.loss", PRESET}

    def reset(*names: str) -> set[str]:
        request = ParametersRequest(deed=ParameterDeed.RESET, names=list(names))
        return set(changed.changed(request).since(tuning))

    assert reset("radio.loss") == {"ball.mass", PRESET}
    assert reset("ball", "noise") == {"radio.loss"}
    assert reset() == set()
    with pytest.raises(TouchlineError, match=r"time\.physics_step cannot be changed"):
        reset("time.physics_step")


def test_what_the_match_file_says_of_the_radio_is_what_the_match_began_with() -> None:
    tuning = Tuning.of(MatchConfig.model_validate({"radio": {"loss": 0.25}}))
    (loss,) = tuning.describe(["radio.loss"])
    assert (loss.value, loss.initial, loss.origin) == (0.25, 0.25, "the match file")


def test_what_was_noted_of_a_change_makes_the_same_change_again(tuning: Tuning) -> None:
    changed = tuning.with_values({"drive.max_speed": 2.0, PRESET: "paper"})
    assert tuning.laid_over(changed.since(tuning)) == changed


def test_the_numbers_of_a_type_of_robots_are_parameters_of_their_own(tuning: Tuning) -> None:
    (slow,) = tuning.describe(["types.slow.drive.max_speed"])
    assert (slow.value, slow.unit, slow.live) == (2.0, "m/s", True)
    assert slow.origin == tuning.initial.origins["types.slow.drive.max_speed"]
    changed = tuning.with_values({"types.slow.drive.max_speed": 1.0})
    assert (changed.types["slow"].drive.max_speed, changed.profile.drive.max_speed) == (1.0, 4.0)
    with pytest.raises(TouchlineError, match=r"types\.keeper\.robot\.frame_width cannot be changed"):
        tuning.with_values({"types.keeper.robot.frame_width": 0.5})
    with pytest.raises(TouchlineError, match=r"types\.slwo"):
        tuning.describe(["types.slwo.drive.max_speed"])


def test_what_a_type_does_not_change_follows_the_standard_robot_again_after_a_reset(tuning: Tuning) -> None:
    own = tuning.with_values({"types.slow.kicker.max_ground_speed": 3.0})
    assert own.since(tuning) == {"types.slow.kicker.max_ground_speed": 3.0}
    back = own.changed(ParametersRequest(deed=ParameterDeed.RESET, names=["types.slow"]))
    assert back.since(own) == {"types.slow.kicker.max_ground_speed": None}
    assert back == tuning
    assert back.with_values({"kicker.max_ground_speed": 8.0}).types["slow"].kicker.max_ground_speed == 8.0
    assert own.laid_over(back.since(own)) == back


def test_a_list_leaves_out_what_a_type_has_from_the_standard_robot(tuning: Tuning) -> None:
    listed = {parameter.name for parameter in tuning.describe()}
    assert "types.slow.drive.max_speed" in listed and "types.slow.kicker.max_ground_speed" not in listed
