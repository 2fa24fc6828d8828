"""A command that takes groups of options looks and works as if each stood in its own signature."""

from dataclasses import dataclass
from inspect import signature
from typing import Annotated

import pytest
import typer
from typer.testing import CliRunner

from touchline.cli.option_groups import expand_option_groups


@dataclass(frozen=True)
class Where:
    place: Annotated[str, typer.Argument(help="Where.")]
    height: Annotated[float, typer.Option(help="m")] = 2.0


@expand_option_groups
def build(first: Annotated[int, typer.Argument()], where: Where, loud: bool = False) -> None:
    """Build it.

    Example: build 1 here
    """
    typer.echo(f"{first} {where} {loud}")


@pytest.fixture
def app() -> typer.Typer:
    app = typer.Typer()
    app.command()(build)
    return app


def test_fields_stand_in_the_place_of_the_bundle_with_their_defaults() -> None:
    assert list(signature(build).parameters) == ["first", "place", "height", "loud"]
    assert signature(build).parameters["height"].default == 2.0


def test_the_command_gets_the_bundle_whole(app: typer.Typer) -> None:
    result = CliRunner().invoke(app, ["3", "here", "--height", "1.5", "--loud"])
    assert result.stdout == "3 Where(place='here', height=1.5) True\n"


def test_what_a_field_without_default_needs_is_asked_for(app: typer.Typer) -> None:
    result = CliRunner().invoke(app, ["3"])
    assert result.exit_code == 2
    assert "PLACE" in result.output or "place" in result.output


def test_the_help_is_the_commands_own() -> None:
    assert build.__doc__ is not None and build.__doc__.startswith("Build it.")
