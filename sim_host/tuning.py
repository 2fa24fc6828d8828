"""The numbers of a running match by their names: those it began with, those in force, and what may be changed."""

import dataclasses
import functools
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, get_type_hints

from schemas.errors import TouchlineError, did_you_mean
from schemas.match_config import MatchConfig
from schemas.noise import PRESETS, sensing_of
from schemas.parameters import Parameter, ParameterDeed, ParametersRequest, Setting, Value
from schemas.profile import Changes, Profile, check_consistent
from schemas.quantity import Choice, Quantity, checked, meanings
from schemas.robot_model import RobotModel, types_of
from schemas.sections import SECTIONS, TYPE_SECTIONS, Sensing

PRESET = "noise.preset"
"""The one parameter that is no number of the profile: whose noise robots perceive with."""
_OWN_NOISE = "profile"
_MATCH_FILE = "the match file"
_STANDARD_ROBOT = "the standard robot"

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


TYPES = "types"


class _Place(NamedTuple):
    """Where a parameter stands in a profile, and what it means."""

    section: str
    key: str
    meaning: Quantity | Choice
    kind: Any
    type: str | None = None
    """The type of robots whose number it is; nothing for the profile's own."""

    def of(self, profile: Profile) -> Any:
        """The value that is in force."""
        section = getattr(profile, self.section)
        own = self.own(profile)
        return getattr(section, self.key) if own is None else own

    def own(self, profile: Profile) -> Any:
        """The value that a type has for itself; nothing where it is as the standard robot."""
        return profile.types[self.type].get(self.section, {}).get(self.key) if self.type is not None else None


@functools.cache
def _places(types: tuple[str, ...]) -> Mapping[str, _Place]:
    """Name → place, for a profile that knows these types of robots."""
    places = {}
    for section, cls in SECTIONS.items():
        hints = get_type_hints(cls)
        for key, meaning in meanings(cls).items():
            places[f"{section}.{key}"] = _Place(section, key, meaning, hints[key])
    for one in types:
        own = {f"{TYPES}.{one}.{name}": place for name, place in places.items() if place.section in TYPE_SECTIONS}
        places |= {name: place._replace(type=one) for name, place in own.items() if place.type is None}
    return places


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
        profile = config.load_profile().with_types(config.types, f'match "{config.name}"')
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
            place = self._places[name]
            if place.section == "sensing" and preset != _OWN_NOISE:
                raise TouchlineError(
                    f'{name} has no effect while {PRESET} is "{preset}"; set {PRESET} to "{_OWN_NOISE}" with it'
                )
            fit[name] = checked(value, place.meaning, place.kind, name)
        return self.laid_over(fit if PRESET not in values else {**fit, PRESET: preset})

    def since(self, before: "Tuning") -> dict[str, Setting]:
        """What differs from an earlier state: name → what it is set to now."""
        now, then = self._settings(), before._settings()
        return {name: setting for name, setting in now.items() if setting != then[name]}

    def _settings(self) -> dict[str, Setting]:
        """Every parameter; of a type's number that is the standard robot's, nothing."""
        numbers = {
            name: _listed(place.of(self.profile) if place.type is None else place.own(self.profile))
            for name, place in self._places.items()
        }
        return {**numbers, PRESET: self.preset}

    def _reset(self, names: Iterable[str]) -> "Tuning":
        """What is named as the match began with it; fixed parameters are passed over where a section is named."""
        asked = list(names)
        for name in asked:
            if name in self._names():
                self._check_live(name)
        meant = self._expanded(asked) if asked else self._names()
        began = self.at_start._settings()
        return self.laid_over({name: began[name] for name in meant if _why_fixed(name) is None})

    def laid_over(self, settings: Mapping[str, Any]) -> "Tuning":
        """The same with these settings, each of which is known to be fit.

        Raises:
            TouchlineError: they do not fit each other.
        """
        sections: dict[str, dict[str, Any]] = {}
        types = {name: {section: dict(own) for section, own in changes.items()} for name, changes in self._types()}
        for name, setting in settings.items():
            if name == PRESET:
                continue
            place, value = self._places[name], tuple(setting) if isinstance(setting, list) else setting
            if place.type is None:
                sections.setdefault(place.section, {})[place.key] = value
            elif value is None:
                types[place.type].get(place.section, {}).pop(place.key, None)
            else:
                types[place.type].setdefault(place.section, {})[place.key] = value
        changed: dict[str, Any] = {
            section: dataclasses.replace(getattr(self.profile, section), **numbers)
            for section, numbers in sections.items()
        }
        kept = {name: {section: own for section, own in changes.items() if own} for name, changes in types.items()}
        profile = dataclasses.replace(self.profile, types=kept, **changed)
        check_consistent(profile)
        return dataclasses.replace(self, profile=profile, preset=settings.get(PRESET, self.preset))

    @property
    def _places(self) -> Mapping[str, _Place]:
        return _places(tuple(self.profile.types))

    def _types(self) -> Iterable[tuple[str, Changes]]:
        return self.profile.types.items()

    def _names(self) -> list[str]:
        return [*self._places, PRESET]

    def _expanded(self, names: Iterable[str]) -> list[str]:
        """The parameters that are meant, each once, in the order of the profile.

        Nothing named stands for all, but for the numbers of types that are the standard robot's.
        """
        known, asked = self._names(), list(names)
        meant: set[str] = set()
        for name in asked:
            below = [other for other in known if other == name or other.startswith(f"{name}.")]
            if not below:
                raise TouchlineError(_unknown(name, known))
            meant.update(below)
        if asked:
            return [name for name in known if name in meant]
        now, began = self._settings(), self.at_start._settings()
        return [name for name in known if now[name] is not None or began[name] is not None]

    def _check_live(self, name: str) -> None:
        known = self._names()
        if name not in known:
            raise TouchlineError(_unknown(name, known))
        why = _why_fixed(name)
        if why is not None:
            raise TouchlineError(f"{name} cannot be changed; {why}")

    def value(self, name: str) -> Value:
        """A parameter in force, by its name."""
        return self.preset if name == PRESET else _listed(self._places[name].of(self.profile))

    def _parameter(self, name: str) -> Parameter:
        place = self._places.get(name)
        meaning = _PRESET_MEANING if place is None else place.meaning
        why = _why_fixed(name)
        about: dict[str, Any] = {"unit": "", "words": []}
        if isinstance(meaning, Choice):
            about["words"] = list(meaning.words)
        else:
            about = {"unit": meaning.unit, "low": _bound(meaning.low), "high": _bound(meaning.high)}
        return Parameter(
            name=name,
            says=meaning.says,
            origin=_MATCH_FILE if place is None else self.initial.origins.get(name, _STANDARD_ROBOT),
            value=self.value(name),
            initial=self.at_start.value(name),
            live=why is None,
            why_not=why or "",
            **about,
        )


def _listed(value: Any) -> Value:
    return list(value) if isinstance(value, tuple) else value


def _why_fixed(name: str) -> str | None:
    """Of a type's number, what holds for the standard robot's."""
    standard = name.split(".", maxsplit=2)[2] if name.startswith(f"{TYPES}.") else name
    return FIXED.get(standard) or FIXED.get(standard.split(".", maxsplit=1)[0])


def _unknown(name: str, known: list[str]) -> str:
    section = name.split(".", maxsplit=1)[0]
    near = [other for other in known if other.startswith(f"{section}.")]
    sections = list(dict.fromkeys(other.split(".")[0] for other in known))
    return f"{name} is no parameter; {did_you_mean(name, near) if near else did_you_mean(section, sections)}"


def _bound(limit: float) -> float | None:
    return limit if math.isfinite(limit) else None
