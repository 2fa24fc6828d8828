"""The page on physics: its tables are those of the profiles, and its plots can be drawn."""

import importlib.util
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from pytest import approx

from schemas.config.sections import SECTIONS


@pytest.fixture(scope="module")
def drawing(generator: Callable[[str], ModuleType]) -> ModuleType:
    return generator("draw_physics")


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs" / "physics.md").read_text("utf-8")


def test_the_tables_are_those_of_the_profiles(text: str, generator: Callable[[str], ModuleType]) -> None:
    tables = generator("physics_tables")
    assert text == tables.filled(text), "run: .venv/bin/python docs/generate/physics_tables.py"
    shown = re.findall(r"<!-- table (\w+) -->", text)
    assert sorted(shown) == sorted(set(SECTIONS) - {"safety"})


def test_every_plot_is_shown_and_light(root: Path, text: str, drawing: ModuleType) -> None:
    shown = re.findall(r"\(images/physics_(\w+)\.png\)", text)
    assert sorted(shown) == sorted(drawing.PLOTS)
    for name in shown:
        picture = (root / "docs" / "images" / f"physics_{name}.png").read_bytes()
        assert picture.startswith(b"\x89PNG") and len(picture) < 150_000


FURTHER = [pytest.param(name, marks=pytest.mark.long) for name in ("ball_roll", "bounce", "duel", "dribble_turn")]


@pytest.mark.parametrize("name", ["step_response", *FURTHER])
def test_a_plot_is_drawn_from_a_run(name: str, drawing: ModuleType) -> None:
    figure = drawing.PLOTS[name]()
    lines = [line for panel in figure.axes for line in panel.lines if len(line.get_xdata()) > 2]
    assert lines
    assert all(np.ptp(np.asarray(line.get_xdata(), dtype=float)) > 0.1 for line in lines)


@pytest.mark.parametrize("drive", ["msl", "omni"])
def test_the_benchmark_steps_more_robots_than_a_match_file_allows(drive: str, root: Path) -> None:
    """The benchmark measures what this steps once."""
    spec = importlib.util.spec_from_file_location("bench_physics", root / "benchmarks" / "bench_physics.py")
    assert spec is not None and spec.loader is not None
    bench = importlib.util.module_from_spec(spec)
    sys.modules["bench_physics"] = bench
    spec.loader.exec_module(bench)
    rig = bench.TickRig(drive, 22)
    for body in (rig.tick, rig.ready, rig.step_raw, rig.sense):
        body()
    assert len(rig.snapshot.robots) == 22
    assert bench.exponent([size**1.5 for size in bench.SIZES]) == approx(1.5)
    rig.close()
    del sys.modules["bench_physics"]
