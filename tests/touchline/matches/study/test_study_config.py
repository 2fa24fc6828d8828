from collections.abc import Callable
from pathlib import Path

import pytest

from schemas.errors import TouchlineError
from schemas.side import Side

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pandas", reason="experiments need the extra study")

from touchline.matches.study.cells import combinations
from touchline.matches.study.study_config import Study, load_study
from touchline.matches.study.study_plan import StudyPlan

MakePlan = Callable[[str], StudyPlan]

Load = Callable[[str], Study]


def test_factors_are_the_same_as_nested_tables_and_as_dotted_keys(study: Load) -> None:
    nested = study("[factors]\nradio.loss = [0, 0.4]\n[settings.radio]\ndelay = 0.1")
    quoted = study('[factors]\n"radio.loss" = [0, 0.4]\n[settings]\n"radio.delay" = 0.1')
    assert nested == quoted
    assert nested.factors == {"radio.loss": [0, 0.4]}


def test_a_grid_has_all_combinations_the_first_factor_varying_slowest(study: Load) -> None:
    grid = study('[factors]\nradio.loss = [0, 0.4]\nnoise = ["paper", "perfect"]')
    assert [tuple(levels.values()) for levels in combinations(grid)] == [
        (0, "paper"), (0, "perfect"), (0.4, "paper"), (0.4, "perfect"),
    ]  # fmt: skip


def test_cells_can_be_listed_in_place_of_a_grid(study: Load) -> None:
    listed = study("[[cells]]\nradio.loss = 0\nradio.delay = 0.1\n[[cells]]\nradio.loss = 0.4\nradio.delay = 0.5")
    assert combinations(listed) == [
        {"radio.loss": 0, "radio.delay": 0.1}, {"radio.loss": 0.4, "radio.delay": 0.5},
    ]  # fmt: skip


def test_noise_teams_and_parameters_of_brains_are_factors(plan: MakePlan) -> None:
    cells = plan(
        'seeds = "1"\n[settings]\ncyan = "simple"\n[factors]\nnoise = ["perfect"]\n'
        'magenta = ["nubot"]\nteams.cyan.parameters.press = [0.2, 0.8]'
    ).cells
    config = cells[1].config
    assert config.noise.preset == "perfect"
    assert config.team(Side.CYAN).parameters == {"press": 0.8}
    assert config.team(Side.MAGENTA).brain == "robot_agent.teams.nubot:NuBot"
    assert cells[1].label == "noise = perfect, magenta = nubot, teams.cyan.parameters.press = 0.8"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[factors]\nradio.loss = 0.2", r"factors\.radio\.loss is 0\.2; a list"),
        ("[factors]\nradio.loss = [0, 0]", "has a level twice"),
        ("[factors]\nradio.loss = [0]\n[settings]\nradio.loss = 1", "both a setting and varied"),
        ("[factors]\nseed = [1, 2]", "seed is not for factors"),
        ("[factors]\nradio.loss = [0]\n[[cells]]\nnoise = 'paper'", "factors and cells are both given"),
        ("[[cells]]\nradio.loss = 0\n[[cells]]\nnoise = 'paper'", "cells have different keys"),
        ("responses = ['score']", 'responses has "score", of one side\'s task; write both_sides = false'),
        ("seeds = '9-3'", "seeds is '9-3'|seeds is \"9-3\"|9-3 ends before it begins"),
        ("repeats = 3", "repeats"),
        ("until_interval = 0", "until_interval is 0"),
        ("seeds = ", "not TOML"),
    ],
)
def test_a_wrong_study_file_is_refused_in_one_line(study: Load, text: str, message: str) -> None:
    with pytest.raises(TouchlineError, match=message) as caught:
        study(text)
    assert "\n" not in str(caught.value)
    assert "try.toml" in str(caught.value)


def test_a_missing_study_file_is_named() -> None:
    with pytest.raises(TouchlineError, match=r"nowhere\.toml: No such file.*give the path of a study file"):
        load_study(Path("nowhere.toml"))


def test_a_rule_book_that_is_a_level_is_in_the_folder_of_the_study(plan: MakePlan, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('extends = "msl"\n')
    cells = plan('[factors]\nrules = ["msl", "mine.toml"]').cells
    assert [cell.label for cell in cells] == ["rules = msl", "rules = mine.toml"]
    assert [cell.config.rule_book_tables is None for cell in cells] == [True, False]


def test_a_level_that_no_match_file_may_have_is_refused_by_its_key(plan: MakePlan) -> None:
    with pytest.raises(TouchlineError, match=r"radio\.loss is 3"):
        plan("[factors]\nradio.loss = [0, 3]")
