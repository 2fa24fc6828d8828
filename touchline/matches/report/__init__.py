"""Pages from templates: HTML files that open from disk, without a network and without scripts."""

from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined


def page_of(template: str, **values: Any) -> str:
    """The page of a template with these values; what they contain is text, unless it is marked as HTML."""
    return _environment().get_template(template).render(values)


def part_of(template: str, macro: str, *arguments: Any, **values: Any) -> str:
    """What a macro of a template makes of its arguments, as it stands in a page with these values."""
    module = _environment().get_template(template).make_module(values)
    return str(getattr(module, macro)(*arguments))


@cache
def _environment() -> Environment:
    return Environment(
        loader=PackageLoader(__name__),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
