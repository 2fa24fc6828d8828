"""The numbers of a running match by their names: those it began with, those in force, and what may be changed."""

import dataclasses
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, get_type_hints

from schemas.errors import TouchlineError, did_you_mean
from schemas.match_config import MatchConfig
from schemas.noise import PRESETS, sensing_of
from schemas.parameters import Parameter, ParameterDeed, ParametersRequest, Value
from schemas.profile import SECTIONS, Profile, Sensing, check_consistent, load_profile
from schemas.quantity import Choice, Quantity, checked, meanings
from schemas.robot_model import RobotModel, types_of

PRESET = "noise.preset"
"""The one parameter that is no number of the profile: whose noise robots perceive with."""
_OWN_NOISE = "profile"
_MATCH_FILE = "the match file"

_TIME = "time steps are fixed for a match: everything is counted in ticks"
_SIZE = "sizes are fixed for a match: robots, referee and recording were told them"
FIXED: Mapping[str, str] = {
    "time": _TIME,
    "field": _SIZE,
    "robot.radius": _SIZE,
    "robot.height": _SIZE,
    "robot.frame_width": _SIZE,
    "robot.frame_depth": _SIZE,
    "ball.radius": _SIZE,
}
"""Section or parameter → why it cannot be changed while the match runs; all others can."""


class _Place(NamedTuple):
    """Where a parameter stands in a profile, and what it means."""

    section: str
    key: str
    meaning: Quantity | Choice
    kind: Any


def _places() -> Iterator[tuple[str, _Place]]:
    for section, cls in SECTIONS.items():
        hints = get_type_hints(cls)
        for key, meaning in meanings(cls).items():
            yield f"{section}.{key}", _Place(section, key, meaning, hints[key])


_PLACES: Mapping[str, _Place] = dict(_places())
_PRESET_MEANING = Choice("what robots perceive with: the profile's own noise, or a named one", PRESETS)


@dataclass(frozen=True, slots=True)
class Tuning:
    """What a match runs with; every change makes a new one."""

    initial: Profile
    """The profile with the radio of the match file."""
    initial_preset: str
    profile: Profile
    preset: str

    @classmethod
    def of(cls, config: MatchConfig) -> "Tuning":
        """What a match begins with.

        Raises:
            TouchlineError: the profile or a type of robots cannot be read.
        """
        profile = load_profile(config.profile).with_types(config.types, f'match "{config.name}"')
        given = {key: value for key, value in config.radio.model_dump().items() if value is not None}
        origins = {**profile.origins, **{f"radio.{key}": _MATCH_FILE for key in given}}
        profile = dataclasses.replace(profile, radio=dataclasses.replace(profile.radio, **given), origins=origins)
        return cls(profile, config.noise.preset, profile, config.noise.preset)

    @property
    def at_start(self) -> "Tuning":
        """What the match began with."""
        return Tuning(self.initial, self.initial_preset, self.initial, self.initial_preset)

    @property
    def types(self) -> dict[str, RobotModel]:
        """Every type that a robot may have."""
        return types_of(self.profile)

    @property
    def sensing(self) -> Sensing:
        """What robots perceive with."""
        return sensing_of(self.preset, self.profile.sensing)

    def describe(self, names: Iterable[str] = ()) -> list[Parameter]:
        """Parameters by name or section, or all of them, in the order of the profile.

        Raises:
            TouchlineError: a name that is not known.
        """
        return [self._parameter(name) for name in self._expanded(names)]

    def changed(self, request: ParametersRequest) -> "Tuning":
        """What the match runs with when this request has been followed.

        Raises:
            TouchlineError: something in it is unknown, fixed, out of range, or does not fit the rest.
        """
        if request.deed is ParameterDeed.SET:
            return self.with_values(request.values)
        if request.deed is ParameterDeed.RESET:
            return self._reset(request.names)
        return self

    def with_values(self, values: Mapping[str, Value]) -> "Tuning":
        """The same with other values.

        Raises:
            TouchlineError: as `changed`.
        """
        if not values:
            raise TouchlineError("no value is given; name a parameter and its new value")
        preset = str(values.get(PRESET, self.preset))
        fit: dict[str, Any] = {}
        for name, value in values.items():
            self._check_live(name)
            if name == PRESET:
                checked(value, _PRESET_MEANING, str, PRESET)
                continue
            place = _PLACES[name]
            if place.section == "sensing" and preset != _OWN_NOISE:
                raise TouchlineError(
                    f'{name} has no effect while {PRESET} is "{preset}"; set {PRESET} to "{_OWN_NOISE}" with it'
                )
            fit[name] = checked(value, place.meaning, place.kind, name)
        return self.laid_over(fit if PRESET not in values else {**fit, PRESET: preset})

    def since(self, before: "Tuning") -> dict[str, Value]:
        """What differs from an earlier state: name → value now."""
        return {name: self.value(name) for name in self._names() if self.value(name) != before.value(name)}

    def _reset(self, names: Iterable[str]) -> "Tuning":
        """What is named as the match began with it; fixed parameters are passed over where a section is named."""
        asked = list(names)
        for name in asked:
            if name in self._names():
                self._check_live(name)
        meant = [name for name in self._expanded(asked) if _why_fixed(name) is None]
        return self.laid_over({name: self.at_start.value(name) for name in meant})

    def laid_over(self, fit: Mapping[str, Any]) -> "Tuning":
        """The same with these values, each of which is known to be fit: name → value.

        Raises:
            TouchlineError: they do not fit each other.
        """
        sections: dict[str, dict[str, Any]] = {}
        for name, value in fit.items():
            if name != PRESET:
                place = _PLACES[name]
                sections.setdefault(place.section, {})[place.key] = tuple(value) if isinstance(value, list) else value
        changed: dict[str, Any] = {
            section: dataclasses.replace(getattr(self.profile, section), **numbers)
            for section, numbers in sections.items()
        }
        profile = dataclasses.replace(self.profile, **changed)
        check_consistent(profile)
        return dataclasses.replace(self, profile=profile, preset=fit.get(PRESET, self.preset))

    def _names(self) -> list[str]:
        return [*_PLACES, PRESET]

    def _expanded(self, names: Iterable[str]) -> list[str]:
        """The parameters that are meant, each once, in the order of the profile."""
        known = self._names()
        meant: set[str] = set()
        for name in names:
            below = [other for other in known if other == name or other.startswith(f"{name}.")]
            if not below:
                raise TouchlineError(_unknown(name, known))
            meant.update(below)
        return [name for name in known if name in meant] if meant else known

    def _check_live(self, name: str) -> None:
        known = self._names()
        if name not in known:
            raise TouchlineError(_unknown(name, known))
        why = _why_fixed(name)
        if why is not None:
            raise TouchlineError(f"{name} cannot be changed; {why}")

    def value(self, name: str) -> Value:
        """A parameter in force, by its name."""
        return self.preset if name == PRESET else _listed(_at(self.profile, name))

    def _parameter(self, name: str) -> Parameter:
        meaning = _PRESET_MEANING if name == PRESET else _PLACES[name].meaning
        why = _why_fixed(name)
        about: dict[str, Any] = {"unit": "", "words": []}
        if isinstance(meaning, Choice):
            about["words"] = list(meaning.words)
        else:
            about = {"unit": meaning.unit, "low": _bound(meaning.low), "high": _bound(meaning.high)}
        return Parameter(
            name=name,
            says=meaning.says,
            origin=_MATCH_FILE if name == PRESET else self.initial.origins[name],
            value=self.value(name),
            initial=self.at_start.value(name),
            live=why is None,
            why_not=why or "",
            **about,
        )


def _at(profile: Profile, name: str) -> Any:
    place = _PLACES[name]
    return getattr(getattr(profile, place.section), place.key)


def _listed(value: Any) -> Value:
    return list(value) if isinstance(value, tuple) else value


def _why_fixed(name: str) -> str | None:
    return FIXED.get(name) or FIXED.get(name.split(".", maxsplit=1)[0])


def _unknown(name: str, known: list[str]) -> str:
    section = name.split(".", maxsplit=1)[0]
    near = [other for other in known if other.startswith(f"{section}.")]
    sections = list(dict.fromkeys(other.split(".")[0] for other in known))
    return f"{name} is no parameter; {did_you_mean(name, near) if near else did_you_mean(section, sections)}"


def _bound(limit: float) -> float | None:
    return limit if math.isfinite(limit) else None
