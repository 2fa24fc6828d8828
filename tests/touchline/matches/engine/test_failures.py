"""The worst matches of a plan: what they have in common, and the match that they are again."""

from dataclasses import replace
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from touchline.matches.engine.failures import in_common, keep_failures
from touchline.matches.engine.outcome import Failed, Played
from touchline.matches.engine.planned_match import PlannedMatch, Way
from touchline.matches.engine.play import play
from touchline.matches.engine.play_list import PlayedList, play_list


def played(*events: str) -> Played:
    return Played(identity="x", figures=None, playing_time=1.0, chain="", events=dict.fromkeys(events, 1))


def test_an_event_that_failures_have_more_often_is_named_and_the_most_telling_comes_first() -> None:
    failures = [played("ball_out", "goal:magenta"), played("goal:magenta"), played("ball_out", "goal:magenta")]
    others = [played("ball_out"), played("goal:cyan"), played("ball_out"), played("foul:cyan (pushing)")]
    first, *rest = in_common(failures, others)
    assert (first.event, first.failures, first.others) == ("goal:magenta", 3, 0)
    assert rest == []  # 2 of 3 and 2 of 4 are alike


@pytest.mark.parametrize(("failures", "others"), [([], [played("goal:cyan")]), ([played("goal:cyan")], [])])
def test_without_failures_or_without_others_nothing_is_in_common(failures: list[Played], others: list[Played]) -> None:
    assert in_common(failures, others) == []


def test_a_failure_that_was_another_match_when_it_was_played_again_is_named(tmp_path: Path) -> None:
    planned = PlannedMatch(load_match(None, {"duration": 0.2, "teams.cyan.size": 1}), label="first, seed 1")
    outcome = play(planned)
    assert isinstance(outcome, Played)
    kept = keep_failures([planned], {planned.identity: outcome}, lambda _: 1.0, 5, tmp_path, 1, json=True)
    assert [one.recording for one in kept.kept] == [tmp_path / "first_seed_1.mcap"]
    assert (kept.lines[0], kept.missing) == ("1 failure, the worst first:", [])
    other = replace(outcome, chain="0" * len(outcome.chain))
    kept = keep_failures([planned], {planned.identity: other}, lambda _: 1.0, 1, tmp_path, 1, json=True)
    sentence = "first, seed 1 was another match when it was played again; does its brain use a clock?"
    assert (kept.kept, kept.missing, kept.lines) == ([], [sentence], ["no failures", sentence])


def test_a_failure_whose_brain_raises_when_it_is_played_again_is_named_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "raises_again.py").write_text("def act(sight):\n    raise ValueError('no idea')\n")
    config = load_match(None, {"duration": 0.2, "teams.cyan.size": 1, "teams.cyan.brain": "raises_again:act"})
    planned = PlannedMatch(config, brain_folder=tmp_path, label="seed 1")
    outcomes = {planned.identity: replace(played(), identity=planned.identity)}
    (said,) = keep_failures([planned], outcomes, lambda _: 1.0, 1, tmp_path, 1, json=True).missing
    assert said.startswith("seed 1 failed when it was played again: cyan1, tick 0: ValueError: no idea")


def test_failures_are_played_again_as_before_and_those_after_an_interrupt_are_not_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    planned = [PlannedMatch(load_match(None, {"seed": seed}), way=Way.PROCESSES) for seed in (1, 2, 3)]
    outcomes = {one.identity: replace(played("goal:magenta"), identity=one.identity) for one in planned}
    asked: list[PlannedMatch] = []

    def interrupted(matches: list[PlannedMatch], *_: object, json: bool) -> PlayedList:
        asked.extend(matches)
        return PlayedList({planned[0].identity: outcomes[planned[0].identity]}, is_interrupted=True)

    monkeypatch.setattr("touchline.matches.engine.failures.play_list", interrupted)
    outcomes[planned[2].identity] = replace(played(), identity=planned[2].identity)
    worths = {one.identity: float(one.config.seed) for one in planned}
    twice = [*planned, planned[0]]
    kept = keep_failures(twice, outcomes, lambda one: worths[one.identity], 2, tmp_path, 1, json=True)
    assert [(one.identity, one.way) for one in asked] == [(one.identity, Way.PROCESSES) for one in planned[:2]]
    assert kept.is_interrupted and kept.missing == []
    assert kept.lines[2:] == ["  goal:magenta: in 1 of 1 of them, in 0 of the 1 others"]


@pytest.mark.processes
def test_a_list_has_matches_of_programs_in_processes(tmp_path: Path) -> None:
    """In one process such a team cannot be built."""
    config = load_match(None, {"duration": 0.2, "teams.cyan.command": ["./missing"]})
    planned = PlannedMatch(config, way=Way.PROCESSES, logs=tmp_path)
    outcome = play_list([planned], 1, "", lambda *_: "", json=True).outcomes[planned.identity]
    assert isinstance(outcome, Failed) and "missing" in outcome.reason, outcome
