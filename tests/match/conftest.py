"""Matches of real processes on loopback: started, watched, harmed and ended."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from runtime.bus.endpoint import with_free_port
from runtime.process.settings_file import write_settings
from schemas.config.settings import Settings
from support.process_story import Listener, Program, is_running

NO_PYBULLET = """
from importlib.machinery import PathFinder
find = PathFinder.find_spec
PathFinder.find_spec = lambda name, *more: None if name == "pybullet" else find(name, *more)
"""
"""As `sitecustomize`, makes PyBullet a module that is not installed."""


@pytest.fixture(scope="module")
def start(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Program]]:
    """Starts Python programs, each in its folder, and ends those that are left."""
    running: list[Program] = []

    def start(
        *arguments: str, folder: Path, name: str = "touchline", settings: Settings | None = None, **environment: str
    ) -> Program:
        if settings is not None:
            write_settings(settings, folder / f"{name}.json")
            arguments = (*arguments, "--settings", f"{name}.json")
        running.append(Program(list(arguments), folder, name, environment))
        return running[-1]

    yield start
    for program in running:
        program.end()


@pytest.fixture(scope="module")
def listen() -> Iterator[Callable[..., Listener]]:
    """Opens clients of a program's match, as soon as its host is there."""
    open_ones: list[Listener] = []

    def listen(match: str, endpoint: str, program: Program, *, every_tick: bool = True) -> Listener:
        open_ones.append(Listener(match, endpoint, program, every_tick=every_tick))
        return open_ones[-1]

    yield listen
    for listener in open_ones:
        listener.bus.close()


@pytest.fixture(name="is_running")
def is_running_fixture() -> Callable[[int], bool]:
    return is_running


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the programs of a test file run."""
    return tmp_path_factory.mktemp("match")


@pytest.fixture(scope="module")
def endpoint() -> str:
    return with_free_port("tcp/127.0.0.1:0")


@pytest.fixture(scope="module")
def without_pybullet(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The environment of a machine on which PyBullet is not installed."""
    place = tmp_path_factory.mktemp("without_pybullet")
    (place / "sitecustomize.py").write_text(NO_PYBULLET)
    others = os.environ.get("PYTHONPATH")
    return {"PYTHONPATH": os.pathsep.join([str(place), *([others] if others else [])])}
