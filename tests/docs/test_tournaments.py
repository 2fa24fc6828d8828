"""docs/many_matches.md and the cup that ships say what the program does."""

import re
from pathlib import Path

from schemas.side import Side
from touchline.matches.cup.cup_config import CupConfig, FormatConfig, TableConfig, TeamEntry, load_cup
from touchline.matches.cup.cup_plan import match_config
from touchline.matches.cup.cup_state import state_of
from touchline.matches.cup.tie_breaks import CRITERIA, ORDERS


def document(root: Path) -> str:
    return (root / "docs" / "many_matches.md").read_text("utf-8").partition("## Cups")[2].partition("\n## ")[0]


def test_the_cup_that_ships_is_a_double_round_robin_of_twelve_matches_with_valid_teams(root: Path) -> None:
    cup = load_cup(root / "matches" / "cup.toml")
    due = [one.slot for one in state_of(cup, lambda _: None).matches if not one.slot.is_admission]
    assert len(due) == 12
    for slot in due:
        config = match_config(cup, slot)
        assert tuple(config.team(side).name for side in Side) == slot.sides


def test_the_cup_file_of_the_document_loads_and_shows_every_key(root: Path, tmp_path: Path) -> None:
    example, _ = re.findall(r"```toml\n(.*?)```", document(root), re.DOTALL)
    more = "".join(f'[[teams]]\nname = "{name}"\nbrain = "simple"\n' for name in "ABC")
    (tmp_path / "autumn.toml").write_text(f"{example}\n{more}")
    cup = load_cup(tmp_path / "autumn.toml")
    assert cup.teams[0].challenge == 12.5
    shown = set(re.findall(r"^(?:# )?(\w+) = |^\[+(\w+)\]", example, re.MULTILINE))
    words = {word for pair in shown for word in pair if word}
    asked = {key for model in (CupConfig, FormatConfig, TableConfig) for key in model.model_fields}
    asked |= set(TeamEntry.model_fields) - {"command", "stdio", "size"}
    assert asked - {"until_significant"} <= words


def test_the_rule_book_of_the_document_shortens_the_breaks_of_a_cup(root: Path, tmp_path: Path) -> None:
    _, rules = re.findall(r"```toml\n(.*?)```", document(root), re.DOTALL)
    (tmp_path / "short.toml").write_text(rules)
    cup = load_cup(root / "matches" / "cup.toml")
    short = cup.model_copy(update={"match": {**cup.match, "rules": str(tmp_path / "short.toml")}})
    long_, short_ = (one.match_config().load_rule_book().periods for one in (cup, short))
    assert [one.half_time_break + 2 * one.parking for one in (long_, short_)] == [60.0, 2.0]


def test_orders_and_criteria_are_those_of_the_program(root: Path) -> None:
    text = document(root)
    for name, order in ORDERS.items():
        (row,) = re.findall(rf"^\| `{name}` \| (.*) \|$", text, re.MULTILINE)
        written = (
            row.replace("technical challenge", "challenge")
            .replace("red cards", "reds")
            .replace("yellow cards", "yellows")
        )
        assert tuple(written.split(", ")) == order
    assert all(f"`{name}`" in " ".join(text.split()) for name in CRITERIA)
