"""The pages of a cup: a folder that opens from disk."""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from touchline.matches.cup.cup_config import CupConfig, FormatConfig, FormatKind, TeamEntry
from touchline.matches.cup.cup_state import CupState, Ended, Slot, state_of
from touchline.matches.cup.match_result import MatchResult
from touchline.matches.cup.site import Site, signed

NAMES = ["Alpha", "Beta & <b>Co</b>", "Gamma", "Δelta", "E!", "E?"]


class Links(HTMLParser):
    """The links of a page, and whether its elements are closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[str] = []
        self._open: list[str] = []
        self.feed(text)
        assert self._open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        self.found += [values["href"] or ""] if tag == "a" else []
        if tag not in ("meta", "br", "line", "circle", "link", "input", "path"):
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag not in ("line", "circle", "path"):
            assert self._open.pop() == tag


def ended(slot: Slot) -> Ended | None:
    teams = slot.fixture.teams
    if slot.name == "group A 1":
        forfeit = MatchResult(teams, (3, 0), forfeited_by=(teams[1],))
        return Ended(forfeit, "id", f"{teams[1]} did not start: no <module>", evidence="evidence/group_a_1")
    if slot.name == "final":
        return Ended(MatchResult(teams, (1, 1), (3, 4)), "id")
    return Ended(MatchResult(teams, (2, 1)), "id")


def state(kind: FormatKind = FormatKind.GROUPS) -> CupState:
    cup = CupConfig(
        title="A & B", teams=[TeamEntry(name=name, brain="simple") for name in NAMES], format=FormatConfig(kind=kind)
    )
    return state_of(cup, ended)


@pytest.mark.parametrize("kind", FormatKind)
def test_each_link_of_each_page_leads_to_a_file_of_the_folder(tmp_path: Path, kind: FormatKind) -> None:
    Site(tmp_path, {}).write(state(kind), running=False)
    pages = sorted(tmp_path.rglob("*.html"))
    assert len(list((tmp_path / "teams").iterdir())) == len(NAMES)
    assert len(list((tmp_path / "matches").iterdir())) == len(state(kind).matches)
    for one in pages:
        for target in Links(one.read_text("utf-8")).found:
            if "evidence" not in target:
                assert (one.parent / target).is_file(), f"{one.name}: {target}"


def test_pages_need_no_network_and_no_script(tmp_path: Path) -> None:
    Site(tmp_path, {}).write(state(), running=False)
    text = (tmp_path / "index.html").read_text("utf-8")
    assert "<script" not in text and not re.search(r"https?://|@import|url\(", text)


def test_names_of_teams_are_text(tmp_path: Path) -> None:
    Site(tmp_path, {}).write(state(), running=False)
    for one in tmp_path.rglob("*.html"):
        assert "<b>Co</b>" not in one.read_text("utf-8")
    assert "Beta &amp; &lt;b&gt;Co&lt;/b&gt;" in (tmp_path / "index.html").read_text("utf-8")


def test_the_first_page_has_table_cross_table_bracket_and_winner(tmp_path: Path) -> None:
    Site(tmp_path, {}).write(state(), running=False)
    text = (tmp_path / "index.html").read_text("utf-8")
    for part in ("Group A", "Group B", "Every match", "Knock-out", "third place", "Winner", "1 : 1 (3 : 4)"):
        assert part in text


def test_a_running_cup_loads_its_pages_again_and_a_complete_one_does_not(tmp_path: Path) -> None:
    site = Site(tmp_path, {})
    site.write(state(), running=True)
    assert 'http-equiv="refresh"' in (tmp_path / "index.html").read_text("utf-8")
    site.write(state(), running=False)
    assert 'http-equiv="refresh"' not in (tmp_path / "index.html").read_text("utf-8")


def test_the_page_of_a_forfeit_shows_its_evidence(tmp_path: Path) -> None:
    logs = tmp_path / "evidence" / "group_a_1"
    logs.mkdir(parents=True)
    (logs / "magenta2.log").write_text("ValueError: <ball> is None")
    Site(tmp_path, {}).write(state(), running=False)
    text = (tmp_path / "matches" / "group_a_1.html").read_text("utf-8")
    assert "ValueError: &lt;ball&gt; is None" in text
    assert "did not start: no &lt;module&gt;" in text


def test_the_page_of_a_team_lists_its_own_matches(tmp_path: Path) -> None:
    Site(tmp_path, {}).write(state(), running=False)
    (page,) = (tmp_path / "teams").glob("alpha_*.html")
    listed = re.findall(r"matches/(\w+)\.html", page.read_text("utf-8"))
    assert listed == ["admission_1", "group_a_2", "group_a_3", "semi_final_2", "third_place"]


def test_scores_in_the_row_of_a_team_begin_with_its_goals(tmp_path: Path) -> None:
    Site(tmp_path, {}).write(state(FormatKind.ROUND_ROBIN), running=False)
    text = (tmp_path / "index.html").read_text("utf-8")
    rows = re.findall(r"<tr><td>.*?</tr>", text[text.index("Every match") : text.index("Matches</h2>")])
    scores = [re.findall(r">(\d : \d)<", row) for row in rows]
    assert sum(row.count("2 : 1") for row in scores) == sum(row.count("1 : 2") for row in scores) == 15


@pytest.mark.parametrize(("value", "text"), [(3, "+3"), (-3.4, "−3"), (0.4, "0"), (-0.4, "0")])
def test_numbers_have_their_sign_and_zero_has_none(value: float, text: str) -> None:
    assert signed(value) == text
