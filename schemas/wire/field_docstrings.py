"""Descriptions of fields: the docstrings below them in the source, for JSON Schemas and for the page on the protocol.

They are read on demand. Pydantic's `use_attribute_docstrings` reads them when a class is created, which takes 0.1 s in
every process of a match.
"""

import ast
import inspect
import sys
from functools import cache
from typing import get_args

from schemas.wire.faults import hints_of

_LIBRARIES = frozenset({"builtins", "msgspec", "pydantic"})
"""Whose classes are bases of ours, and describe no field of a message."""


def descriptions(cls: type) -> dict[str, str]:
    """Field → its docstring, or what its type declares about it: the meaning of a number with its unit."""
    declared = {
        name: str(item.description)
        for name, hint in hints_of(cls).items()
        for item in get_args(hint)[1:]
        if hasattr(item, "meaning")
    }
    return field_docstrings(cls) | declared


def field_docstrings(cls: type) -> dict[str, str]:
    """Field → its docstring in one line; the fields of base classes are included."""
    found: dict[str, str] = {}
    for base in reversed(cls.__mro__):
        if base.__module__.split(".")[0] not in _LIBRARIES:
            found |= _docstrings_of_module(base.__module__).get(base.__name__, {})
    return found


@cache
def _docstrings_of_module(module: str) -> dict[str, dict[str, str]]:
    """Class → field → docstring."""
    found: dict[str, dict[str, str]] = {}
    for node in ast.parse(inspect.getsource(sys.modules[module])).body:
        if not isinstance(node, ast.ClassDef):
            continue
        fields = found[node.name] = {}
        for field, below in zip(node.body, node.body[1:], strict=False):
            match field, below:
                case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(value=ast.Constant(value=str() as text)):
                    fields[name] = " ".join(text.split())
    return found
