"""`touchline parameters`: reads and changes the parameters of a running match."""

import json as json_values
import math
from typing import Annotated

import typer

from runtime.bus.settings import ClientSettings
from schemas.errors import TouchlineError
from schemas.messages.parameters import Parameter, ParameterOperation, ParametersReply, ParametersRequest, Value
from schemas.topics import PARAMETERS
from schemas.wire.faults import FaultError
from schemas.wire.part_faults import validated
from touchline.commands.cli import options
from touchline.commands.cli.bus_client import ask_host
from touchline.commands.cli.option_groups import with_option_groups
from touchline.launch.terminal.aligned import aligned
from touchline.launch.terminal.json_text import json_text

app = typer.Typer(
    no_args_is_help=True,
    help="Read and change the parameters of a running match: ball, limits, noise, radio.\n\n"
    "Example: touchline parameters set ball.rolling_deceleration=1.2",
)

Names = Annotated[list[str], typer.Argument(metavar="NAME...", help="Parameters, or sections: ball, radio.loss.")]


@app.command("list")
@with_option_groups
def list_all(json: options.Json = False, *, connection: ClientSettings) -> None:
    """List every parameter: value, unit, range, description, and whether it can be changed.

    Example: touchline parameters list --json | jq '.[] | select(.live).name'
    """
    _show(_query(connection, operation=ParameterOperation.LIST), json=json)


@app.command("get")
@with_option_groups
def get(names: Names, json: options.Json = False, *, connection: ClientSettings) -> None:
    """Show parameters or whole sections.

    Example: touchline parameters get ball radio.loss
    """
    _show(_query(connection, operation=ParameterOperation.GET, names=names), json=json)


@app.command("set")
@with_option_groups
def set_values(
    settings: Annotated[list[str], typer.Argument(metavar="NAME=VALUE...", help="In the parameter's own unit.")],
    json: options.Json = False,
    *,
    connection: ClientSettings,
) -> None:
    """Change parameters between two ticks: either all of them, or none if one is refused.

    Example: touchline parameters set radio.loss=0.3 noise.preset=perfect
    """
    _show(_query(connection, operation=ParameterOperation.SET, values=dict(map(_setting, settings))), json=json)


@app.command("reset")
@with_option_groups
def reset(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME...]", help="Parameters or sections; by default all.")
    ] = None,
    json: options.Json = False,
    *,
    connection: ClientSettings,
) -> None:
    """Reset parameters to their values at the start of the match.

    Example: touchline parameters reset ball
    """
    _show(_query(connection, operation=ParameterOperation.RESET, names=names or []), json=json)


def _setting(argument: str) -> tuple[str, Value]:
    name, equals, text = argument.partition("=")
    if not equals:
        raise TouchlineError(f'"{argument}" has no value; write NAME=VALUE, like ball.rolling_deceleration=1.2')
    return name.strip(), _value(text.strip())


def _value(text: str) -> Value:
    """A finite number or a list of them if the text is one, else the text itself."""
    try:
        value = json_values.loads(text)
    except ValueError:
        return text
    items = value if isinstance(value, list) else [value]
    are_numbers = all(isinstance(item, int | float) and not isinstance(item, bool) for item in items)
    return value if are_numbers and all(math.isfinite(item) for item in items) else text


def _query(connection: ClientSettings, **content: object) -> ParametersReply:
    try:
        request = validated(ParametersRequest, content)
    except FaultError as error:
        raise TouchlineError(
            f"{error.fault.value!r} is no parameter; touchline parameters list shows all of them"
        ) from None
    reply: ParametersReply = ask_host(connection, PARAMETERS, request)
    return reply


def _show(reply: ParametersReply, *, json: bool) -> None:
    if json:
        typer.echo(json_text(reply.parameters, indent=2))
        return
    lines = [_line(parameter) for parameter in reply.parameters]
    for line in aligned(lines):
        typer.echo(line)


def _line(parameter: Parameter) -> tuple[str, str, str, str, str]:
    """Name, value with unit, range, initial value if changed, description."""
    unit = "" if parameter.unit in ("", "1") else f" {parameter.unit}"
    limits = (
        ", ".join(parameter.options) if parameter.options else f"{_bound(parameter.low)} to {_bound(parameter.high)}"
    )
    before = "" if parameter.value == parameter.initial else f"was {_value_text(parameter.initial)}"
    description = parameter.description if parameter.live else f"{parameter.description} (fixed)"
    return parameter.name, f"{_value_text(parameter.value)}{unit}", limits, before, description


def _value_text(value: Value) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _bound(limit: float | None) -> str:
    return "any" if limit is None else f"{limit:g}"
