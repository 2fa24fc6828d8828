"""Option groups: options that are defined once, as the fields of a class, and shared by several commands.

A parameter of a command whose type is a settings model or a dataclass becomes one option per field, and the command
receives the model or the dataclass. An option of a model is made from its field: name, type, default, limits, and the
docstring as help. A parameter of type `Annotated[dict[str, Any], FieldsOf(Model, "a", "b")]` stands for some fields of
a model; the command receives those whose options were used.
"""

from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from inspect import Parameter, Signature, signature
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, TypeVar, Union, get_args, get_origin, get_type_hints

import typer
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from schemas.config.settings import CommandLine, Settings
from schemas.errors import TouchlineError
from schemas.wire.faults import FaultError, Path
from schemas.wire.field_docstrings import field_docstrings
from schemas.wire.part_faults import validated

T = TypeVar("T")


class FieldsOf:
    """Some fields of a model as options; the command receives a dictionary of the options that were used."""

    def __init__(self, model: type[BaseModel], *names: str, **options: str | tuple[str, ...]) -> None:
        """The fields `names`, by default all; `options` renames a field's option, or gives it several names."""
        self.model = model
        self.options: dict[str, tuple[str, ...]] = {
            name: (name,) for name in names or (() if options else model.model_fields)
        }
        self.options |= {name: (word,) if isinstance(word, str) else word for name, word in options.items()}


def with_option_groups(command: Callable[..., None]) -> Callable[..., None]:
    """The command with its groups expanded to single options, for the command-line parser."""
    hints = get_type_hints(command, include_extras=True)
    plain: list[Parameter] = []
    groups: dict[str, _Group] = {}
    for name, parameter in signature(command).parameters.items():
        if (group := _group_of(hints[name])) is not None:
            groups[name] = group
        plain += group.parameters if group is not None else [parameter.replace(annotation=hints[name])]

    def run(**values: Any) -> None:
        built = {name: group.build(_taken(values, group)) for name, group in groups.items()}
        command(**values, **built)

    run.__name__, run.__doc__, run.__module__ = command.__name__, command.__doc__, command.__module__
    run.__annotations__ = {one.name: one.annotation for one in plain} | {"return": None}
    parameters = [one.replace(kind=Parameter.KEYWORD_ONLY) for one in plain]
    run.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    return run


def from_options(model: type[T], **content: object) -> T:
    """The model or struct with these option values.

    Raises:
        TouchlineError: a value is invalid, or two values contradict each other; the message names the option.
    """
    try:
        return validated(model, content)
    except FaultError as error:
        fault = error.fault
        option, rest = _option_of(model, fault.path)
        named = fault._replace(path=(option, *rest)) if option is not None else fault._replace(path=())
        raise TouchlineError(named.sentence()) from None


class _Group(NamedTuple):
    """The parameters of a group, and a function that makes the group from their values."""

    parameters: list[Parameter]
    build: Callable[[dict[str, Any]], Any]


def _taken(values: dict[str, Any], group: _Group) -> dict[str, Any]:
    return {one.name: values.pop(one.name) for one in group.parameters}


def _group_of(annotation: Any) -> _Group | None:
    """The group of a parameter of this type; None for a single option."""
    for extra in getattr(annotation, "__metadata__", ()):
        if isinstance(extra, FieldsOf):
            return _group_of_fields(extra)
    if isinstance(annotation, type) and issubclass(annotation, Settings):
        return _group_of_settings(annotation)
    return _group_of_dataclass(annotation) if is_dataclass(annotation) else None


def _group_of_fields(chosen: FieldsOf) -> _Group:
    parameters = [_parameter(chosen.model, name, *words, is_override=True) for name, words in chosen.options.items()]

    def build(values: dict[str, Any]) -> dict[str, Any]:
        return {name: values[words[0]] for name, words in chosen.options.items() if _is_given(values[words[0]])}

    return _Group(parameters, build)


def _group_of_settings(model: type[Settings]) -> _Group:
    parameters: list[Parameter] = []
    below: dict[str, _Group] = {}
    for name, field in model.model_fields.items():
        if (part := _part_of(field)) is None:
            parameters.append(_parameter(model, name, name, is_override=False))
        elif issubclass(part, Settings):
            below[name] = _group_of_settings(part)
            parameters += below[name].parameters

    def build(values: dict[str, Any]) -> Settings:
        parts = {name: group.build(_taken(values, group)) for name, group in below.items()}
        return from_options(model, **{name: value for name, value in values.items() if _is_given(value)}, **parts)

    return _Group(parameters, build)


def _group_of_dataclass(cls: Any) -> _Group:
    hints = get_type_hints(cls, include_extras=True)
    parameters: list[Parameter] = []
    below: dict[str, _Group] = {}
    for field in fields(cls):
        if (group := _group_of(hints[field.name])) is not None:
            below[field.name] = group
            parameters += group.parameters
        else:
            default = Parameter.empty if field.default is MISSING else field.default
            parameters.append(
                Parameter(field.name, Parameter.KEYWORD_ONLY, default=default, annotation=hints[field.name])
            )

    def build(values: dict[str, Any]) -> Any:
        parts = {name: group.build(_taken(values, group)) for name, group in below.items()}
        return cls(**values, **parts)

    return _Group(parameters, build)


def _parameter(model: type[BaseModel], field_name: str, *names: str, is_override: bool) -> Parameter:
    """The option of a field; an override has no default."""
    field = model.model_fields[field_name]
    limits = _limits(field) if issubclass(model, Settings) else {}  # a match file reports its limits itself
    default = field.get_default(call_default_factory=True)
    kind = _without_none(field.annotation)
    words = [name.replace("_", "-") for name in names]
    known = next((extra for extra in field.metadata if isinstance(extra, CommandLine)), CommandLine())
    has_no_form = kind is bool and (is_override or default is True)
    option = typer.Option(
        *(f"--{word}/--no-{word}" if has_no_form else f"--{word}" for word in words),
        help=field_docstrings(model).get(field_name, ""),
        envvar=known.environment,
        metavar=known.metavar,
        show_default=_shown(default) if is_override else True,
        **limits,
    )
    if is_override or (not field.is_required() and default in (None, [])):
        return Parameter(names[0], Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, option])
    default = Parameter.empty if field.is_required() else default
    return Parameter(names[0], Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, option])


def _part_of(field: FieldInfo) -> type[BaseModel] | None:
    """The model type of a field, optional or not; None for a plain value."""
    kind = _without_none(field.annotation)
    return kind if isinstance(kind, type) and issubclass(kind, BaseModel) else None


def _without_none(annotation: Any) -> Any:
    """The type of a field, without None and without annotations, in a list neither."""
    if get_origin(annotation) in (Union, UnionType):
        (annotation,) = (one for one in get_args(annotation) if one is not NoneType)
    if get_origin(annotation) is list:
        return list[_without_none(get_args(annotation)[0])]  # type: ignore[misc]
    return get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation


def _limits(field: FieldInfo) -> dict[str, Any]:
    """The inclusive limits of a value, for the command line; the model itself checks all of its limits."""
    known = (("min", "ge"), ("max", "le"))
    return {word: getattr(one, limit) for one in field.metadata for word, limit in known if hasattr(one, limit)}


def _shown(default: Any) -> str | bool:
    """A default as shown in the help; None, an empty list and a switch are not shown."""
    if default is None or isinstance(default, bool | list):
        return False
    return str(default.value if isinstance(default, Enum) else default)


def _is_given(value: Any) -> bool:
    return value is not None and value != []


def _option_of(model: Any, path: Path) -> tuple[str | None, Path]:
    """The option of an invalid field, and the path below it; None if fields contradict each other."""
    for number, step in enumerate(path):
        fields_known = getattr(model, "model_fields", {})
        part = _part_of(fields_known[str(step)]) if str(step) in fields_known else None
        if part is None or not issubclass(part, Settings):
            return "--" + str(step).replace("_", "-"), path[number + 1 :]
        model = part
    return None, ()
