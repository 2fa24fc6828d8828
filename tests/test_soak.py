"""`make soak` names what grows, and nothing that stays the same."""

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

CHECK = Path(__file__).parents[1] / "benchmarks" / "check_soak.py"


@pytest.fixture(scope="module")
def soak() -> ModuleType:
    spec = importlib.util.spec_from_file_location("check_soak", CHECK)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def faults_of(soak: ModuleType, mb: float = 0.0, threads: float = 0.0, files: float = 0.0) -> list[str]:
    """The faults of a process that grows by this much a minute, for seven minutes."""
    minutes = [3.0 + number / 30 for number in range(210)]
    samples = [
        soak.Sample(at, 150.0 + mb * (at - 3.0), round(12 + threads * (at - 3.0)), round(40 + files * (at - 3.0)))
        for at in minutes
    ]
    found: list[str] = soak.faults(samples)
    return found


def test_a_process_that_stays_the_same_or_grows_by_half_a_megabyte_a_minute_has_no_fault(soak: ModuleType) -> None:
    assert faults_of(soak) == faults_of(soak, mb=0.5) == []


def test_memory_threads_and_descriptors_that_grow_are_named_with_figures(soak: ModuleType) -> None:
    assert faults_of(soak, mb=2.5, threads=1.0, files=2.0) == [
        "memory grows by 2.50 MB a minute",
        "threads grow from 12 to 19",
        "descriptors grow from 40 to 54",
    ]


def test_a_check_without_time_beyond_the_warm_up_is_refused(
    soak: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["check_soak.py", "--minutes", "4"])
    with pytest.raises(SystemExit):
        soak.main()
    assert "--minutes is 4; at least 6, half of them are warm-up" in capsys.readouterr().err
