"""The worst matches of a plan: what they have in common, and the match that they are again."""

from dataclasses import replace
from pathlib import Path

import pytest

from schemas.config.match_config import load_match
from schemas.errors import TouchlineError
from touchline.matches.engine.failures import in_common, keep_failures
from touchline.matches.engine.outcome import Played
from touchline.matches.engine.planned_match import PlannedMatch
from touchline.matches.engine.play_list import play_list


def played(*events: str) -> Played:
    return Played(identity="x", figures=None, playing_time=1.0, chain="", events=dict.fromkeys(events, 1))


def test_an_event_that_failures_have_more_often_is_named_and_the_most_telling_comes_first() -> None:
    failures = [played("ball_out", "goal:magenta"), played("goal:magenta"), played("ball_out", "goal:magenta")]
    others = [played("ball_out"), played("goal:cyan"), played("ball_out"), played("foul:cyan (pushing)")]
    first, *rest = in_common(failures, others)
    assert (first.event, first.failures, first.others) == ("goal:magenta", 3, 0)
    assert rest == []  # 2 of 3 and 2 of 4 are alike


def test_without_failures_nothing_is_in_common() -> None:
    assert in_common([], [played("goal:cyan")]) == []


def test_a_failure_that_was_another_match_when_it_was_played_again_is_an_error(tmp_path: Path) -> None:
    planned = PlannedMatch(load_match(None, {"duration": 0.2, "teams.cyan.size": 1}), label="first, seed 1")
    outcome = play_list([planned], 1, "", lambda *_: "", json=True).outcomes[planned.identity]
    assert isinstance(outcome, Played)
    kept = keep_failures([planned], {planned.identity: outcome}, lambda _: 1.0, 5, tmp_path, 1, json=True)
    assert [one.recording for one in kept.kept] == [tmp_path / "first_seed_1.mcap"]
    assert kept.lines[0] == "1 failures, the worst first:"
    other = replace(outcome, chain="0" * len(outcome.chain))
    with pytest.raises(TouchlineError, match="first, seed 1 was another match when it was played again"):
        keep_failures([planned], {planned.identity: other}, lambda _: 1.0, 1, tmp_path, 1, json=True)
