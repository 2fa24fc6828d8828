"""Studies of constructed results and of short matches."""

import shutil
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from schemas.config.match_config import MatchConfig
from support.short_study import SHORT, Run
from touchline.matches.engine.outcome import Outcome
from touchline.matches.engine.planned_match import PlannedMatch

if TYPE_CHECKING:
    from touchline.matches.study.run_study import StudyResult
    from touchline.matches.study.study_config import Study
    from touchline.matches.study.study_plan import StudyPlan

MakePlan = Callable[[str], "StudyPlan"]


@pytest.fixture
def study(tmp_path: Path) -> "Callable[[str], Study]":
    """The study of a text."""

    def load(text: str) -> "Study":
        from touchline.matches.study.study_config import load_study

        path = tmp_path / "try.toml"
        path.write_text(text)
        return load_study(path)

    return load


@pytest.fixture
def plan(study: "Callable[[str], Study]", tmp_path: Path) -> MakePlan:
    """The plan of the study of a text."""

    def make(text: str) -> "StudyPlan":
        from touchline.matches.study.cells import cells_of
        from touchline.matches.study.study_plan import StudyPlan

        loaded = study(text)
        return StudyPlan(loaded, cells_of(loaded, tmp_path))

    return make


@pytest.fixture
def bare_plan(study: "Callable[[str], Study]") -> MakePlan:
    """A plan whose cells have levels and no match of their own: for constructed results."""

    def make(text: str) -> "StudyPlan":
        from touchline.matches.study.cells import Cell, combinations
        from touchline.matches.study.study_plan import StudyPlan

        loaded = study(text)
        return StudyPlan(loaded, [Cell(levels, MatchConfig()) for levels in combinations(loaded)])

    return make


@pytest.fixture
def table() -> Callable[..., Any]:
    """A table of results with these values of a response: cell → one value a seed."""

    def make(response: str, cells: Mapping[int, Sequence[float | None]]) -> Any:
        import pandas as pd

        return pd.DataFrame(
            {"cell": cell, "seed": seed, "swapped": False, response: value}
            for cell, values in cells.items()
            for seed, value in enumerate(values, start=1)
        )

    return make


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The folder of a study."""
    return tmp_path / "study"


@dataclass
class Labels:
    """Collects the labels of the matches that were played."""

    played: list[str]

    def __call__(self, planned: PlannedMatch, outcome: Outcome) -> str:
        del outcome
        self.played.append(planned.label)
        return planned.label


def play(folder: Path, text: str, played: list[str] | None = None, *, fresh: bool = False) -> "StudyResult":
    """Play the study of a text in a folder; its results are in `study` there."""
    from touchline.matches.study.cells import cells_of
    from touchline.matches.study.run_study import run_study
    from touchline.matches.study.study_config import load_study
    from touchline.matches.study.study_plan import StudyPlan

    path, home = folder / "try.toml", folder / "study"
    path.write_text(text)
    study = load_study(path)
    plan = StudyPlan(study, cells_of(study, folder), folder, home)
    return run_study(plan, home, ThreadPoolExecutor(1), Labels(played if played is not None else []), fresh=fresh)


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Plays the study of a text into `home`."""
    return partial(play, tmp_path)


@pytest.fixture(scope="session")
def short_study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the short study, which was played once."""
    folder = tmp_path_factory.mktemp("short")
    play(folder, SHORT)
    return folder


@pytest.fixture
def played(short_study: Path, tmp_path: Path) -> Path:
    """A copy of the short study in `home`."""
    shutil.copytree(short_study, tmp_path, dirs_exist_ok=True)
    return tmp_path / "study"
