"""A recording is verified by the profile and the rule book that it embeds, whatever the shipped ones have become."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from recordings.inspection.contradictions import contradictions
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.config.number_files import NumberFiles
from schemas.config.profile import load_profile, shipped_profile
from schemas.config.soccer.rule_book import load_rule_book, shipped_rule_book
from schemas.errors import TouchlineError
from sim_host.soccer.game import Soccer
from touchline.commands.cli.command_line import app
from touchline.verify.compare_brain import compare_brain
from touchline.verify.resimulate import verify

SHORTER_STOP = {2.0: 0.3, 0.5: 0.1}
"""Pause of a shipped rule book → that of its next version, s."""
TWO_A_SIDE = {"teams.cyan.size": 2, "teams.magenta.size": 2}


@pytest.fixture
def later_numbers(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A later program: its shipped files have another version, and its rule books a shorter pause after STOP."""
    read = NumberFiles.read

    def changed(files: NumberFiles, name: str) -> dict[str, Any]:
        tables = read(files, name)
        pause = tables.get("restarts", {}).get("stop_to_signal", {"value": 2.0})
        pause["value"] = SHORTER_STOP[pause["value"]]
        return tables | {"version": tables["version"] + 90}

    monkeypatch.setattr(NumberFiles, "read", changed)
    forget()
    assert load_rule_book("msl").restarts.stop_to_signal == 0.3
    assert load_rule_book("friendly").restarts.stop_to_signal == 0.1
    yield
    forget()


def forget() -> None:
    """Read shipped files again, as another process would."""
    shipped_profile.cache_clear()
    shipped_rule_book.cache_clear()


@pytest.fixture(scope="module")
def today(tmp_path_factory: pytest.TempPathFactory, match_recorder: Callable[..., None]) -> Path:
    path = tmp_path_factory.mktemp("today") / "match.mcap"
    match_recorder(path, load_match(None, {"seed": 3, "duration": 10.0, **TWO_A_SIDE}), until=14.0)
    return path


def is_verified_with_its_referee(path: Path) -> None:
    verdict = verify(path, referee=True)
    assert verdict.difference is None
    assert not verdict.contradictions
    assert verdict.identical and verdict.ticks > 500


@pytest.mark.usefixtures("later_numbers")
def test_a_recording_of_today_is_identical_when_the_shipped_rule_book_has_changed(today: Path) -> None:
    is_verified_with_its_referee(today)


@pytest.mark.usefixtures("later_numbers")
def test_its_sights_are_simulated_again_by_the_embedded_rule_book(today: Path) -> None:
    brain = "robot_agent.teams.simple:Simple"
    comparison = compare_brain(open_recording(today), "cyan1", brain)
    assert comparison.until == "" and comparison.compared > 500


@pytest.mark.usefixtures("later_numbers")
def test_a_recording_without_its_match_file_is_judged_by_the_rule_book_in_its_setup(today: Path, edited: Any) -> None:
    def without_config(name: str, fields: dict[str, str]) -> dict[str, str]:
        return {key: value for key, value in fields.items() if (name, key) != ("manifest", "config")}

    is_verified_with_its_referee(edited(today, "", lambda fields: fields, without_config))


def test_lost_numbers_are_those_that_the_program_ships_in_the_same_version(today: Path) -> None:
    recording = open_recording(today)
    recording.attachments.clear()
    config = config_of(recording)
    assert config is not None
    assert config.load_rule_book() == load_rule_book("friendly") and config.load_profile() == load_profile("msl")


def test_the_embedded_rule_book_is_whole(today: Path) -> None:
    recording = open_recording(today)
    tables = json.loads(recording.attachments["rules.json"])
    assert "extends" not in tables
    config = config_of(recording)
    assert config is not None
    assert config.rule_book_tables == tables
    assert config.load_rule_book() == load_rule_book("friendly")
    assert tables["discipline"]["yellows_to_suspension"]["value"] == 2


def test_a_setup_has_every_section_of_its_rule_book(today: Path) -> None:
    setup = open_recording(today).manifest.setup
    assert setup is not None
    assert setup.rule_book() == load_rule_book("friendly")


def test_a_setup_that_is_not_of_the_embedded_rule_book_is_a_contradiction(today: Path, edited: Any) -> None:
    def other_book(name: str, content: bytes) -> bytes:
        if name != "rules.json":
            return content
        tables = json.loads(content)
        tables["scrum"]["duration"]["value"] = 99.0
        return json.dumps(tables).encode()

    copy = edited(today, "", lambda fields: fields, attachment=other_book)
    assert contradictions(open_recording(copy)) == ["the setup does not follow from the match file: scrum"]


def test_an_embedded_rule_book_that_cannot_be_read_is_named_in_one_line(today: Path, edited: Any) -> None:
    copy = edited(
        today, "", lambda fields: fields, attachment=lambda name, content: b"[" if "rules" in name else content
    )
    with pytest.raises(TouchlineError, match=r"the attached rules\.json is damaged; use another copy$"):
        verify(copy)


@pytest.mark.usefixtures("later_numbers")
@pytest.mark.parametrize(
    ("attachment", "what", "version"), [("rules.json", "rule book friendly", 1), ("profile.json", "profile msl", 2)]
)
def test_lost_numbers_are_not_replaced_by_those_of_another_version(
    today: Path, attachment: str, what: str, version: int
) -> None:
    recording = open_recording(today)
    del recording.attachments[attachment]
    versions = f"version 9{version} in this program, {version} in the recording"
    with pytest.raises(TouchlineError, match=f"{what} has {versions}; use another"):
        config_of(recording)


def test_a_difference_names_the_program_that_recorded_the_match(
    today: Path, monkeypatch: pytest.MonkeyPatch, edited: Any
) -> None:
    def other_score(fields: dict[str, Any]) -> dict[str, Any]:
        return fields | {"score": {"cyan": 9, "magenta": 0}} if fields["tick"] == 100 else fields

    changed = edited(today, "game/state", other_score)
    monkeypatch.setattr(Soccer, "fingerprint", lambda game: {"referee": "another"})
    shown = CliRunner().invoke(app, ["verify", str(changed)], prog_name="touchline")
    assert shown.exit_code == 1
    assert "recorded by a program with another referee: touchline 0.1.0 of 1970-01-01 verifies it" in shown.stdout
    monkeypatch.undo()
    shown = CliRunner().invoke(app, ["verify", str(changed)], prog_name="touchline")
    assert shown.exit_code == 1 and "another referee" not in shown.stdout
