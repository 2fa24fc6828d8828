"""The parameters of a running match by name: initial values, current values, and which of them may be changed."""

import dataclasses
import functools
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, get_type_hints

from schemas.config.match_config import MatchConfig
from schemas.config.noise import PRESETS, sensing_of
from schemas.config.profile import Profile, check_consistent
from schemas.config.quantity import Choice, Quantity, check_value, meanings
from schemas.config.robot_model import RobotModel, types_of
from schemas.config.sections import SECTIONS, TYPE_SECTIONS, Sensing
from schemas.errors import TouchlineError, did_you_mean
from schemas.messages.parameters import Parameter, ParameterOperation, ParametersRequest, Setting, Value

PRESET = "noise.preset"
"""The one parameter that is not part of the profile: the noise that robots perceive with."""
_OWN_NOISE = "profile"
_MATCH_FILE = "the match file"
_STANDARD_ROBOT = "the standard robot"

_TIME_IS_FIXED = "time steps are fixed for a match: everything is counted in ticks"
_SIZE_IS_FIXED = "sizes are fixed for a match: robots, referee and recording rely on them"
FIXED: Mapping[str, str] = {
    "time": _TIME_IS_FIXED,
    "field": _SIZE_IS_FIXED,
    "robot.radius": _SIZE_IS_FIXED,
    "robot.height": _SIZE_IS_FIXED,
    "robot.frame_width": _SIZE_IS_FIXED,
    "robot.frame_depth": _SIZE_IS_FIXED,
    "ball.radius": _SIZE_IS_FIXED,
}
"""Section or parameter → why it cannot be changed while the match runs; all others can be changed."""


TYPES = "types"


class _ParameterPath(NamedTuple):
    """Location of a parameter in a profile, and its meaning."""

    section: str
    key: str
    meaning: Quantity | Choice
    kind: Any
    type: str | None = None
    """The robot type that it belongs to; None for the profile's own parameters."""

    def value_in(self, profile: Profile) -> Any:
        """The current value."""
        section = getattr(profile, self.section)
        override = self.override_in(profile)
        return getattr(section, self.key) if override is None else override

    def override_in(self, profile: Profile) -> Any:
        """The value that a type overrides; None where the type follows the standard robot."""
        return profile.types[self.type].get(self.section, {}).get(self.key) if self.type is not None else None


@functools.cache
def _paths(types: tuple[str, ...]) -> Mapping[str, _ParameterPath]:
    """Name → location, for a profile with these types of robots."""
    paths = {}
    for section, cls in SECTIONS.items():
        hints = get_type_hints(cls)
        for key, meaning in meanings(cls).items():
            paths[f"{section}.{key}"] = _ParameterPath(section, key, meaning, hints[key])
    for one in types:
        override = {f"{TYPES}.{one}.{name}": path for name, path in paths.items() if path.section in TYPE_SECTIONS}
        paths |= {name: path._replace(type=one) for name, path in override.items() if path.type is None}
    return paths


_PRESET_MEANING = Choice("the noise that robots perceive with: the profile's own, or a named one", PRESETS)


@dataclass(frozen=True, slots=True)
class LiveParameters:
    """The parameters of a match; every change makes a new instance."""

    initial: Profile
    """The profile at the start of the match, with the radio of the match file."""
    initial_preset: str
    profile: Profile
    preset: str

    @classmethod
    def of(cls, config: MatchConfig) -> "LiveParameters":
        """The parameters that a match begins with.

        Raises:
            TouchlineError: the profile or a type of robots cannot be read.
        """
        profile = config.load_profile().with_types(config.types, f'match "{config.name}"')
        given = {key: value for key, value in config.radio.model_dump().items() if value is not None}
        origins = {**profile.origins, **{f"radio.{key}": _MATCH_FILE for key in given}}
        profile = dataclasses.replace(profile, radio=dataclasses.replace(profile.radio, **given), origins=origins)
        return cls(profile, config.noise.preset, profile, config.noise.preset)

    @property
    def at_start(self) -> "LiveParameters":
        """The parameters that the match began with."""
        return LiveParameters(self.initial, self.initial_preset, self.initial, self.initial_preset)

    @property
    def types(self) -> dict[str, RobotModel]:
        """All robot types by name."""
        return types_of(self.profile)

    @property
    def sensing(self) -> Sensing:
        """The sensor parameters in force: the profile's own, or the noise preset's."""
        return sensing_of(self.preset, self.profile.sensing)

    def describe(self, names: Iterable[str] = ()) -> list[Parameter]:
        """Parameters by name or section, or all of them, in the order of the profile.

        Raises:
            TouchlineError: a name is unknown.
        """
        return [self._parameter(name) for name in self._expand_names(names)]

    def after_request(self, request: ParametersRequest) -> "LiveParameters":
        """The parameters after this request.

        Raises:
            TouchlineError: a parameter is unknown, fixed, out of range, or inconsistent with the others.
        """
        if request.operation is ParameterOperation.SET:
            return self.with_values(request.values)
        if request.operation is ParameterOperation.RESET:
            return self._reset(request.names)
        return self

    def with_values(self, values: Mapping[str, Value]) -> "LiveParameters":
        """The parameters with other values, which are checked.

        Raises:
            TouchlineError: a parameter is unknown, fixed, out of range, or inconsistent with the others.
        """
        if not values:
            raise TouchlineError("no value is given; name a parameter and its new value")
        preset = str(values.get(PRESET, self.preset))
        checked_values: dict[str, Any] = {}
        for name, value in values.items():
            self._check_live(name)
            if name == PRESET:
                check_value(value, _PRESET_MEANING, str, PRESET)
                continue
            path = self._paths[name]
            if path.section == "sensing" and preset != _OWN_NOISE:
                raise TouchlineError(
                    f'{name} has no effect while {PRESET} is "{preset}"; set {PRESET} to "{_OWN_NOISE}" with it'
                )
            checked_values[name] = check_value(value, path.meaning, path.kind, name)
        return self.with_settings(checked_values if PRESET not in values else {**checked_values, PRESET: preset})

    def changes_since(self, before: "LiveParameters") -> dict[str, Setting]:
        """Differences from an earlier state: name → its setting now."""
        if (self.profile, self.preset) == (before.profile, before.preset):
            return {}
        now, then = self._settings(), before._settings()
        return {name: setting for name, setting in now.items() if setting != then[name]}

    def _settings(self) -> dict[str, Setting]:
        """The setting of every parameter; None for one of a type that follows the standard robot."""
        numbers = {
            name: _as_list(path.value_in(self.profile) if path.type is None else path.override_in(self.profile))
            for name, path in self._paths.items()
        }
        return {**numbers, PRESET: self.preset}

    def _reset(self, names: Iterable[str]) -> "LiveParameters":
        """The parameters with the named ones at their initial values; fixed ones of a named section are skipped."""
        asked = list(names)
        for name in asked:
            if name in self._names():
                self._check_live(name)
        meant = self._expand_names(asked) if asked else self._names()
        began = self.at_start._settings()
        return self.with_settings({name: began[name] for name in meant if _fixed_reason(name) is None})

    def with_settings(self, settings: Mapping[str, Any]) -> "LiveParameters":
        """The parameters with these settings, each of which is already validated.

        Raises:
            TouchlineError: the settings are inconsistent with each other.
        """
        sections: dict[str, dict[str, Any]] = {}
        types = {
            name: {section: dict(override) for section, override in changes.items()}
            for name, changes in self.profile.types.items()
        }
        for name, setting in settings.items():
            if name == PRESET:
                continue
            path, value = self._paths[name], tuple(setting) if isinstance(setting, list) else setting
            if path.type is None:
                sections.setdefault(path.section, {})[path.key] = value
            elif value is None:
                types[path.type].get(path.section, {}).pop(path.key, None)
            else:
                types[path.type].setdefault(path.section, {})[path.key] = value
        changed: dict[str, Any] = {
            section: dataclasses.replace(getattr(self.profile, section), **numbers)
            for section, numbers in sections.items()
        }
        kept = {
            name: {section: override for section, override in changes.items() if override}
            for name, changes in types.items()
        }
        profile = dataclasses.replace(self.profile, types=kept, **changed)
        check_consistent(profile)
        return dataclasses.replace(self, profile=profile, preset=settings.get(PRESET, self.preset))

    @property
    def _paths(self) -> Mapping[str, _ParameterPath]:
        return _paths(tuple(self.profile.types))

    def _names(self) -> list[str]:
        return [*self._paths, PRESET]

    def _expand_names(self, names: Iterable[str]) -> list[str]:
        """The parameters that these names and sections stand for, each once, in the order of the profile.

        No names stand for all parameters, except of types that follow the standard robot.
        """
        known, asked = self._names(), list(names)
        meant: set[str] = set()
        for name in asked:
            below = [other for other in known if other == name or other.startswith(f"{name}.")]
            if not below:
                raise TouchlineError(_unknown_text(name, known))
            meant.update(below)
        if asked:
            return [name for name in known if name in meant]
        now, began = self._settings(), self.at_start._settings()
        return [name for name in known if now[name] is not None or began[name] is not None]

    def _check_live(self, name: str) -> None:
        known = self._names()
        if name not in known:
            raise TouchlineError(_unknown_text(name, known))
        why = _fixed_reason(name)
        if why is not None:
            raise TouchlineError(f"{name} cannot be changed; {why}")

    def value(self, name: str) -> Value:
        """The current value of a parameter."""
        return self.preset if name == PRESET else _as_list(self._paths[name].value_in(self.profile))

    def _parameter(self, name: str) -> Parameter:
        path = self._paths.get(name)
        meaning = _PRESET_MEANING if path is None else path.meaning
        why = _fixed_reason(name)
        about: dict[str, Any] = {"unit": "", "options": []}
        if isinstance(meaning, Choice):
            about["options"] = list(meaning.options)
        else:
            about = {"unit": meaning.unit, "low": _bound(meaning.low), "high": _bound(meaning.high)}
        return Parameter(
            name=name,
            description=meaning.meaning,
            origin=_MATCH_FILE if path is None else self.initial.origins.get(name, _STANDARD_ROBOT),
            value=self.value(name),
            initial=self.at_start.value(name),
            live=why is None,
            fixed_reason=why or "",
            **about,
        )


def _as_list(value: Any) -> Value:
    return list(value) if isinstance(value, tuple) else value


def _fixed_reason(name: str) -> str | None:
    """Why a parameter is fixed, or None; for one of a type, as for the standard robot's."""
    standard = name.split(".", maxsplit=2)[2] if name.startswith(f"{TYPES}.") else name
    return FIXED.get(standard) or FIXED.get(standard.split(".", maxsplit=1)[0])


def _unknown_text(name: str, known: list[str]) -> str:
    section = name.split(".", maxsplit=1)[0]
    near = [other for other in known if other.startswith(f"{section}.")]
    sections = list(dict.fromkeys(other.split(".")[0] for other in known))
    return f"{name} is not a parameter; {did_you_mean(name, near) if near else did_you_mean(section, sections)}"


def _bound(limit: float) -> float | None:
    return limit if math.isfinite(limit) else None
