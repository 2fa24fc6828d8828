"""`import touchline` gives users' code what it needs, and loads nothing that it does not need."""

import subprocess
import sys

import pytest

import touchline


@pytest.mark.parametrize("name", touchline.__all__)
def test_every_public_name_can_be_imported(name: str) -> None:
    assert getattr(touchline, name) is getattr(touchline, name)
    assert name in dir(touchline)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'touchline' has no attribute 'goalie'"):
        touchline.goalie  # noqa: B018


@pytest.mark.parametrize("name", touchline.skills.__all__)
def test_every_skill_can_be_called_from_one_module(name: str) -> None:
    assert getattr(touchline.skills, name) is not None


def test_a_brain_s_import_loads_no_simulator() -> None:
    program = (
        "import sys; from touchline import Brain, Briefing, Command, Drive, Kick, Sight, skills; "
        "print(sorted({'pybullet', 'sim_host', 'recordings', 'typer'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
