"""Options that several commands share, written once: a group of them is a dataclass, and a command takes it whole.

A parameter whose type is such a dataclass becomes one option or argument for each of its fields, in its place; the
command gets the group. The dataclass stands in a module of its own, where its annotations can be read.
"""

from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from inspect import Parameter, Signature, signature
from typing import Any, get_type_hints


def expand_option_groups(command: Callable[..., None]) -> Callable[..., None]:
    """The command as the command line sees it: without groups, each option by itself."""
    hints = get_type_hints(command, include_extras=True)
    seen = signature(command).parameters
    groups = {name: hints[name] for name in seen if is_dataclass(hints[name])}
    parameters: list[Parameter] = []
    for name, parameter in seen.items():
        expanded = _parameters(groups[name]) if name in groups else [parameter.replace(annotation=hints[name])]
        parameters.extend(one.replace(kind=Parameter.KEYWORD_ONLY) for one in expanded)

    def run(**values: Any) -> None:
        grouped = {
            name: group(**{field.name: values.pop(field.name) for field in fields(group)})
            for name, group in groups.items()
        }
        command(**values, **grouped)

    run.__name__, run.__doc__, run.__module__ = command.__name__, command.__doc__, command.__module__
    run.__annotations__ = {one.name: one.annotation for one in parameters} | {"return": None}
    run.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    return run


def _parameters(group: Any) -> list[Parameter]:
    """One for each field, with its default."""
    hints = get_type_hints(group, include_extras=True)
    return [
        Parameter(
            field.name,
            Parameter.KEYWORD_ONLY,
            default=Parameter.empty if field.default is MISSING else field.default,
            annotation=hints[field.name],
        )
        for field in fields(group)
    ]
