"""The studies that ship fit their digests."""

from pathlib import Path

import pytest

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pyarrow", reason="experiments need the extra study")

from concurrent.futures import ThreadPoolExecutor

from touchline.matches.study.cells import cells_of
from touchline.matches.study.study_config import load_study
from touchline.matches.study.study_folder import read_plan
from touchline.matches.study.verify_study import verify_study

STUDIES = sorted((Path(__file__).parents[4] / "studies").glob("*.toml"))


def test_three_studies_ship() -> None:
    assert [path.stem for path in STUDIES] == ["noise", "radio", "sides"]


@pytest.mark.parametrize("file", STUDIES, ids=lambda file: file.stem)
def test_a_published_study_has_the_plan_of_its_file_and_all_files_fit_their_digests(file: Path) -> None:
    study = load_study(file)
    stored = read_plan(file.with_suffix(""))
    assert stored.study == study
    assert [cell.levels for cell in stored.cells] == [cell.levels for cell in cells_of(study, file.parent)]
    assert verify_study(file.with_suffix(""), ThreadPoolExecutor(1), 0, None).faults == []
