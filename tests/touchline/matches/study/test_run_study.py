"""Studies of real matches, short and with few robots."""

import json
import shutil
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from schemas.errors import MatchFailedError, TouchlineError
from support.short_study import ONE_CELL, SHORT, Run

pytest.importorskip("scipy", reason="experiments need the extra study")
pytest.importorskip("pyarrow", reason="experiments need the extra study")
pd = pytest.importorskip("pandas", reason="experiments need the extra study")

from touchline.matches.engine.store import RunStore  # noqa: E402
from touchline.matches.study.comparisons import answers, compared  # noqa: E402
from touchline.matches.study.study_folder import read_study  # noqa: E402
from touchline.matches.study.verify_study import verify_study  # noqa: E402


def test_a_study_leaves_plan_versions_digests_results_and_report(played: Path, home: Path) -> None:
    names = ("plan.json", "versions.json", "digests.json", "results.csv", "results.parquet", "report.html")
    assert [name for name in names if not (home / name).exists()] == []
    table = pd.read_csv(home / "results.csv")
    assert table[["cell", "seed", "level:radio.loss"]].values.tolist() == [
        [1, 1, 0],
        [2, 1, 0.4],
        [1, 2, 0],
        [2, 2, 0.4],
    ]
    assert {"first.goals", "second.goals", "goals", "goals.difference", "first.1.distance", "fouls"} <= {*table.columns}
    report = (home / "report.html").read_text()
    assert report.count("<svg ") >= 4
    assert "http:" not in report.replace("http://www.w3.org", "") and "https:" not in report


def test_a_study_that_is_run_again_plays_only_what_has_no_result(run: Run, played: Path, home: Path) -> None:
    again, fresh = list[str](), list[str]()
    before = (home / "results.csv").read_bytes()
    run(SHORT, again)
    assert again == []
    run(SHORT.replace('"1-2"', '"1-3"'), again)
    assert again == ["cell 1, seed 3", "cell 2, seed 3"]
    run(SHORT, fresh, fresh=True)
    assert len(fresh) == 4
    assert (home / "results.csv").read_bytes() == before


@pytest.mark.parametrize("fresh", [False, True])
def test_a_folder_with_the_results_of_another_plan_is_left_alone(
    run: Run, played: Path, home: Path, fresh: bool
) -> None:
    with pytest.raises(TouchlineError, match="has the results of another plan; give another folder with --out"):
        run(SHORT.replace("0.4", "0.5"), fresh=fresh)
    with closing(RunStore(home)) as store:
        assert len(store.outcomes()) == 4
        with pytest.raises(TouchlineError, match="another process plays this run"):
            run(SHORT, fresh=True)
        assert len(store.outcomes()) == 4
    (home / "plan.json").write_text("{")
    with pytest.raises(TouchlineError, match=r"plan\.json: no JSON object"):
        run(SHORT, fresh=fresh)


def test_seeds_are_added_until_the_interval_is_narrow_or_the_budget_is_spent(run: Run, home: Path) -> None:
    wide = "until_interval = 1e-9\nmost_seeds = 3\n" + SHORT.replace('responses = ["', 'responses = ["distance", "')
    assert run(wide).seeds == [1, 2, 3]
    shutil.rmtree(home)
    with pytest.raises(TouchlineError, match='No match has a figure distanse; did you mean "distance"'):
        run(wide.replace('"distance"', '"distanse"'))
    assert run(wide).seeds == [1, 2, 3], "the matches of the first seed stay"
    shutil.rmtree(home)
    assert run(wide.replace("[factors]\nradio.loss = [0, 0.4]", "").replace("1e-9", "1000.0")).seeds == [1, 2]


def test_a_function_of_a_recording_is_a_response(run: Run, home: Path, tmp_path: Path) -> None:
    (tmp_path / "measures_of_mine.py").write_text(
        "def worlds(recording):\n    return sum(1 for _ in recording.decoded('world'))\n"
    )
    run(ONE_CELL + '[functions]\nworlds = "measures_of_mine:worlds"\n')
    table = pd.read_csv(home / "results.csv")
    assert (table["worlds"] > 50).all()
    assert "Worlds" in (home / "report.html").read_text()
    sample = verify_study(home, ThreadPoolExecutor(1), 1, None)
    assert sample.faults == []
    again = verify_study(home, ThreadPoolExecutor(1), None, None, from_recordings=False)
    assert (again.faults, again.byte_identical) == ([], True)
    run(ONE_CELL, fresh=True)
    with pytest.raises(TouchlineError, match="functions need recordings of all matches; play all again with --fresh"):
        run(ONE_CELL + '[functions]\nworlds = "measures_of_mine:worlds"\n')


def test_a_function_that_is_not_there_is_named_before_any_match(run: Run) -> None:
    played = list[str]()
    with pytest.raises(TouchlineError, match=r'functions.worlds is "nowhere_at_all:worlds"; there is no module'):
        run(SHORT + '[functions]\nworlds = "nowhere_at_all:worlds"\n', played)
    assert played == []


def test_figures_of_kicks_are_no_unknown_names_where_nobody_touched_the_ball(run: Run, home: Path) -> None:
    assert run(ONE_CELL.replace("1.5", "0.2").replace('"distance"', '"passes_completed"')).played == 2
    assert ",first.passes_completed," in (home / "results.csv").read_text()


def test_a_study_in_which_every_match_fails_says_why(run: Run, tmp_path: Path) -> None:
    (tmp_path / "raises_always.py").write_text(
        "class Broken:\n    def __init__(self, briefing):\n        pass\n\n"
        "    def act(self, sight):\n        raise ValueError('no idea')\n"
    )
    with pytest.raises(MatchFailedError, match=r"all 4 matches failed: cyan1.*no idea"):
        run(SHORT.replace("[settings]", '[settings]\ncyan = "raises_always:Broken"'))


def test_a_study_names_matches_that_depend_on_more_than_their_seeds(run: Run, home: Path) -> None:
    assert run(ONE_CELL).disturbed == []
    with closing(RunStore(home)) as store:
        played = next(iter(store.outcomes().values()))
        store.add(replace(played, missed={"cyan1": 3}))
    sentence = "the match does not depend on its seed alone: sights without an answer: cyan1 3"
    assert run(ONE_CELL).disturbed == [f"{played.identity}: {sentence}"]


def test_a_team_against_itself_shows_no_effect_and_one_robot_less_shows_one(run: Run, home: Path) -> None:
    run(
        'seeds = "1-3"\nboth_sides = true\nresponses = ["possession_s.difference"]\n[settings]\nduration = 3\n'
        'cyan = "simple"\nmagenta = "simple"\nteams.cyan.size = 2\n[factors]\nteams.magenta.size = [2, 1]\n'
    )
    stored = read_study(home)
    response = "possession_s.difference"
    groups = compared(stored.plan, stored.table)[response]
    (effect,) = answers(groups)
    itself, one_less = groups[-1].comparisons
    assert itself.estimate.value == pytest.approx(0.0)
    assert itself.estimate.contains_zero is not False
    assert one_less.estimate.contains_zero is False
    assert effect.estimate.contains_zero is False
    assert effect.estimate.value > 0
    assert 'class="found"' in (home / "report.html").read_text()


def test_a_team_on_the_network_is_refused_in_one_process_before_any_match(run: Run) -> None:
    played = list[str]()
    with pytest.raises(TouchlineError, match=r'teams\.cyan has a command.*write way = "processes"'):
        run(SHORT.replace("[settings]", '[settings]\nteams.cyan.command = ["robot"]'), played)
    assert played == []


def test_a_published_study_names_no_path_of_this_machine(played: Path, home: Path, short_study: Path) -> None:
    texts = [path.read_text() for path in home.glob("*.json")] + [(home / "report.html").read_text()]
    assert [text for text in texts if str(short_study) in text] == []
    assert json.loads((home / "plan.json").read_text())["brain_folder"] == ".."
