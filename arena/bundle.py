"""Options that several commands share, written once: a bundle of them is a dataclass, and a command takes it whole.

A parameter whose type is such a dataclass becomes one option or argument for each of its fields, in its place; the
command gets the bundle. The dataclass stands in a module of its own, where its annotations can be read.
"""

from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from inspect import Parameter, Signature, signature
from typing import Any, get_type_hints


def unbundled(command: Callable[..., None]) -> Callable[..., None]:
    """The command as the command line sees it: without bundles, each option by itself."""
    hints = get_type_hints(command, include_extras=True)
    seen = signature(command).parameters
    bundles = {name: hints[name] for name in seen if is_dataclass(hints[name])}
    parameters: list[Parameter] = []
    for name, parameter in seen.items():
        spread = _parameters(bundles[name]) if name in bundles else [parameter.replace(annotation=hints[name])]
        parameters.extend(one.replace(kind=Parameter.KEYWORD_ONLY) for one in spread)

    def run(**words: Any) -> None:
        whole = {
            name: bundle(**{field.name: words.pop(field.name) for field in fields(bundle)})
            for name, bundle in bundles.items()
        }
        command(**words, **whole)

    run.__name__, run.__doc__, run.__module__ = command.__name__, command.__doc__, command.__module__
    run.__annotations__ = {one.name: one.annotation for one in parameters} | {"return": None}
    run.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    return run


def _parameters(bundle: Any) -> list[Parameter]:
    """One for each field, with its default."""
    hints = get_type_hints(bundle, include_extras=True)
    return [
        Parameter(
            field.name,
            Parameter.KEYWORD_ONLY,
            default=Parameter.empty if field.default is MISSING else field.default,
            annotation=hints[field.name],
        )
        for field in fields(bundle)
    ]
