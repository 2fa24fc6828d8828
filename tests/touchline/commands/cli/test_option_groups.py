"""Options that are defined as the fields of a class: a command has them as if each stood in its own signature."""

from dataclasses import dataclass
from inspect import signature
from typing import Annotated, Any

import pytest
import typer
from pydantic import Field, model_validator
from pydantic.fields import FieldInfo
from typer.testing import CliRunner

from coach_gateway.settings import BridgeOptions, GatewaySettings
from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import AgentOptions
from runtime.bus.settings import ClientSettings, ListenSettings
from runtime.bus.without_host import WithoutHost
from schemas.config.match_config import MatchConfig
from schemas.config.match_parts import RecordingConfig
from schemas.config.settings import CommandLine, RecordOptions, Settings
from schemas.errors import TouchlineError
from schemas.wire.field_docstrings import field_docstrings
from sim_host.server.settings import HostSettings
from touchline.commands.cli.command_line import app as touchline
from touchline.commands.cli.option_groups import FieldsOf, from_options, with_option_groups

COMMANDS: dict[str, tuple[type[Settings], ...]] = {
    "host": (HostSettings,),
    "agent": (AgentOptions,),
    "record": (RecorderSettings,),
    "coach serve": (GatewaySettings,),
    "coach bridge": (ClientSettings, BridgeOptions, WithoutHost),
    "match": (BridgeOptions, ListenSettings),
    "replay": (ListenSettings,),
    "referee stop": (ClientSettings,),
    "watch": (ClientSettings,),
}
"""Command → the models whose fields are its options."""


def options_in(model: type[Settings]) -> dict[str, tuple[FieldInfo, str]]:
    """Every field of a model, and of the settings within it, with its docstring; the match comes from a file."""
    found: dict[str, tuple[FieldInfo, str]] = {}
    for name, field in model.model_fields.items():
        parts = [part for part in (field.annotation, *getattr(field.annotation, "__args__", ())) if is_model(part)]
        if not parts:
            found[name] = field, field_docstrings(model)[name]
        elif issubclass(parts[0], Settings):
            found |= options_in(parts[0])
        else:
            assert parts[0] is MatchConfig
    return found


def is_model(kind: Any) -> bool:
    return isinstance(kind, type) and (issubclass(kind, Settings) or kind is MatchConfig)


def option_of(command: str, name: str) -> Any:
    """One option of a command of `touchline`."""
    found: Any = typer.main.get_command(touchline)
    for word in command.split():
        found = found.commands[word]
    (option,) = [one for one in found.params if "--" + name.replace("_", "-") in one.opts]
    return option


FIELDS = [
    pytest.param(command, name, field, docstring, id=f"{command}: {name}")
    for command, models in COMMANDS.items()
    for model in models
    for name, (field, docstring) in options_in(model).items()
]


@pytest.mark.parametrize(("command", "name", "field", "docstring"), FIELDS)
def test_every_field_of_a_settings_model_is_an_option_with_its_help_and_its_default(
    command: str, name: str, field: FieldInfo, docstring: str
) -> None:
    option = option_of(command, name)
    assert option.help == docstring
    assert option.required == field.is_required()
    if not field.is_required():
        assert (option.default or None) == (field.get_default(call_default_factory=True) or None)


@pytest.mark.parametrize("name", RecordOptions.model_fields)
def test_an_option_of_the_recorder_is_a_key_of_settings_and_match_file_and_an_option_of_both_commands(
    name: str,
) -> None:
    """It is added in one place, as a field of `RecordOptions`."""
    field = RecordOptions.model_fields[name]
    assert option_of("match", name).help == option_of("record", name).help == field_docstrings(RecordOptions)[name]
    assert option_of("match", name).default is None  # the match file's value stays
    assert RecordingConfig.model_fields[name].annotation == field.annotation
    assert RecorderSettings.model_fields["record"].annotation is RecordOptions


class Shape(Settings):
    """A part of the settings below."""

    height: Annotated[float, Field(ge=0, le=9)] = 2.0
    """m above the ground."""
    flat: bool = True
    """Whether the roof is flat."""


class House(Settings):
    """Settings of a command."""

    place: Annotated[str, CommandLine(environment="HOUSE_PLACE", metavar="X,Y")]
    """Where it stands."""
    guests: list[str] = Field(default_factory=list)
    """Who lives there."""
    shape: Shape = Shape()
    """How it looks."""

    @model_validator(mode="after")
    def _has_room(self) -> "House":
        if len(self.guests) > 2:
            raise ValueError("three guests need a larger house")
        return self


@dataclass(frozen=True)
class Where:
    place: Annotated[str, typer.Argument(help="Where.")]
    changes: Annotated[dict[str, Any], FieldsOf(Shape, height=("tall", "high"))]
    height: Annotated[float, typer.Option(help="m")] = 2.0


@with_option_groups
def build(first: Annotated[int, typer.Argument()], where: Where, loud: bool = False) -> None:
    """Build it.

    Example: build 1 here
    """
    typer.echo(f"{first} {where} {loud}")


@with_option_groups
def settle(
    house: House, changes: Annotated[dict[str, Any], FieldsOf(RecordingConfig, "sights", "viz", "part_size")]
) -> None:
    typer.echo(f"{house!r} {changes}")


def called(command: Any, *words: str, **environment: str) -> Any:
    app = typer.Typer()
    app.command()(command)
    return CliRunner().invoke(app, list(words), env=environment)


def test_fields_stand_in_the_place_of_the_group_with_their_defaults() -> None:
    assert list(signature(build).parameters) == ["first", "place", "tall", "height", "loud"]
    assert signature(build).parameters["height"].default == 2.0
    assert signature(build).parameters["tall"].default is None


def test_the_command_is_given_the_group_whole() -> None:
    result = called(build, "3", "here", "--height", "1.5", "--high", "4", "--loud")
    assert result.stdout == "3 Where(place='here', changes={'height': 4.0}, height=1.5) True\n"


def test_the_command_is_given_the_settings_whole_with_their_parts() -> None:
    result = called(settle, "--place", "here", "--guests", "ann", "--guests", "bob", "--no-flat")
    house = House(place="here", guests=["ann", "bob"], shape=Shape(flat=False))
    assert result.stdout == f"{house!r} {{}}\n"
    assert called(settle, HOUSE_PLACE="there").stdout == f"{House(place='there')!r} {{}}\n"


def test_some_fields_of_a_model_are_given_where_they_were_typed_in() -> None:
    result = called(settle, "--place", "here", "--no-sights", "--viz", "--part-size", "2")
    assert result.stdout.endswith(" {'sights': False, 'viz': True, 'part_size': 2.0}\n")


def test_what_a_field_without_default_needs_is_asked_for() -> None:
    for command, words in ((build, ["3"]), (settle, [])):
        result = called(command, *words)
        assert result.exit_code == 2
        assert "place" in result.output.lower()


def test_limits_of_a_field_are_limits_of_its_option() -> None:
    result = called(settle, "--place", "here", "--height", "10")
    assert result.exit_code == 2
    assert "--height" in result.output


def test_the_help_is_the_command_s_own() -> None:
    assert build.__doc__ is not None and build.__doc__.startswith("Build it.")


@pytest.mark.parametrize(
    ("content", "says"),
    [({"place": 3}, "--place is 3; text"), ({"place": "here", "shape": {"height": -1}}, "--height is -1; at least 0")],
)
def test_a_value_that_a_model_refuses_is_named_by_its_option(content: dict[str, Any], says: str) -> None:
    with pytest.raises(TouchlineError, match=says):
        from_options(House, **content)


def test_contradicting_values_are_reported_in_the_words_of_the_model() -> None:
    with pytest.raises(TouchlineError, match="three guests need a larger house"):
        from_options(House, place="here", guests=["ann", "bob", "cleo"])
