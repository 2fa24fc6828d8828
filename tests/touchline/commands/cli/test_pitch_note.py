"""A match by the rules of a year names the profile whose pitch these rules describe."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from schemas.config.match_config import load_match
from touchline.commands.cli.command_line import app
from touchline.commands.cli.options import pitch_note


@pytest.mark.parametrize(
    ("rules", "profile", "note"),
    [
        (
            "msl-2016",
            "msl",
            "the rules msl-2016 are for a pitch of 18 × 12 m, profile msl has 22 × 14 m; --profile msl-2016 fits",
        ),
        (
            "msl",
            "msl-2016",
            "the rules msl are for a pitch of 22 × 14 m, profile msl-2016 has 18 × 12 m; --profile msl fits",
        ),
        ("msl-2016", "msl-2016", None),
        ("msl-2016", "paper", None),
        ("msl", "omni", None),
        ("msl-2019", "msl", None),
        ("friendly", "paper", None),
    ],
)
def test_another_pitch_than_that_of_the_rules_is_named_with_the_profile_that_fits(
    rules: str, profile: str, note: str | None
) -> None:
    assert pitch_note(load_match(None, {"rules": rules, "profile": profile})) == note


def test_the_rules_of_each_year_are_listed_in_the_help() -> None:
    shown = " ".join(CliRunner().invoke(app, ["match", "--help"], env={"COLUMNS": "200"}).stdout.split())
    assert all(rules in shown for rules in ("msl-2016", "msl-2019", "or the path of a file"))


def test_a_match_file_may_name_a_rule_book_of_its_own_which_is_embedded(tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text('extends = "msl-2016"\n[people]\nrepair = { value = 5.0, unit = "s", origin = "ours" }\n')
    config = load_match(None, {"rules": str(mine)})
    mine.unlink()
    book = config.load_rule_book()
    assert (book.people.repair, book.discipline.suspension, book.version) == (5.0, 120.0, 0)
