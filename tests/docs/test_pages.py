"""Every document: its links lead somewhere, its commands can be typed, what it names is there, and it can be read."""

import importlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from support.command_lines import fault

ROOT = Path(__file__).parents[2]
LIMITS = {
    "README.md": (85, 110),
    "ARCHITECTURE.md": (150, 110),
    "CHANGELOG.md": (60, 110),
    "CONTRIBUTING.md": (85, 110),
}
LIMITS |= {"docs/first_week.md": (60, 110)}
"""Most lines, and most characters of a line."""
GENERATED = ("docs/protocol.md", "docs/rules.md")
LATER = {"docs/real_robots.md", "docs/ros2.md", "docs/tasks.md", "docs/learning.md"}
"""Pages of what came after the limit on their number was set."""
MOST_WORDS = 5700
RESULTS = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "benchmarks" / "results").glob("*.md"))
PAGES = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "docs").glob("*.md"))
DOCUMENTS = [*LIMITS, *(page for page in PAGES if page not in LIMITS), *RESULTS]
PACKAGES = "schemas|sim_host|robot_agent|coach_gateway|recordings|touchline"
Fenced = Callable[[str, str], list[str]]

every_document = pytest.mark.parametrize("document", DOCUMENTS)


def read(document: str) -> str:
    return (ROOT / document).read_text("utf-8")


def anchors(text: str) -> set[str]:
    """The anchors of its headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def resolve(name: str) -> Any:
    """The object of a dotted name that begins with a package."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            found = getattr(found, part)
        return found
    raise AttributeError(name)


@every_document
def test_every_link_leads_somewhere(document: str) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", read(document)):
        if target.startswith("https://"):
            continue
        path, _, anchor = target.partition("#")
        file = (ROOT / document).parent / path if path else ROOT / document
        assert file.exists(), target
        assert not anchor or anchor in anchors(file.read_text("utf-8")), target


@every_document
def test_every_command_line_can_be_typed(document: str, fenced: Fenced) -> None:
    lines = [line for piece in fenced(read(document), "sh") for line in piece.splitlines()]
    typed = [f"touchline {found[1]}" for line in lines if (found := re.match(r"(?:[A-Z_]+=\S+ )?touchline (.*)", line))]
    typed += [f"touchline match {found[1]}" for line in lines if (found := re.match(r'make match ARGS="(.*)"', line))]
    assert [said for line in typed if (said := fault(line))] == []


@every_document
def test_every_make_target_is_there(document: str, fenced: Fenced) -> None:
    text = read(document)
    targets = set(re.findall(r"^([\w-]+):", read("Makefile"), re.MULTILINE))
    named = set(re.findall(r"^make ([\w-]+)", "\n".join(fenced(text, "sh")), re.MULTILINE))
    assert named | set(re.findall(r"`make ([\w-]+)", text)) <= targets


@every_document
def test_every_module_class_and_function_that_is_named_is_there(document: str) -> None:
    missing = []
    for name in re.findall(rf"`((?:{PACKAGES})\.[\w.]*\w)(?:\(.*?\))?`", read(document)):
        try:
            resolve(name)
        except AttributeError:
            missing.append(name)
    assert missing == []


PUBLIC = (
    "touchline",
    "touchline.learn",
    "touchline.testing",
    "recordings.reading.recording",
    "recordings.soccer.stats.match_statistics",
)
"""The modules that docs/team.md calls public."""


def test_what_users_copy_imports_public_names_only(fenced: Fenced) -> None:
    folders = (ROOT / "examples", ROOT / "touchline" / "team" / "template")
    texts = [piece for document in ("README.md", *PAGES) for piece in fenced(read(document), "python")]
    texts += [path.read_text("utf-8") for folder in folders for path in folder.rglob("*.py")]
    imported = {name for text in texts for name in re.findall(r"^ *(?:from|import) ([\w.]+)", text, re.MULTILINE)}
    assert {name for name in imported if re.match(rf"(runtime|{PACKAGES})\b", name)} <= {*PUBLIC}


@every_document
def test_every_file_that_is_named_is_there(document: str) -> None:
    named = re.findall(r"`([\w.]+/[\w./]*\.\w+)`", read(document))
    ours = [name for name in named if (ROOT / name.split("/")[0]).exists() and not name.startswith("runs/")]
    assert [name for name in ours if not (ROOT / name).exists()] == []


@pytest.mark.parametrize("document", LIMITS)
def test_what_everybody_reads_is_short(document: str) -> None:
    most, width = LIMITS[document]
    lines = read(document).splitlines()
    assert len(lines) <= most
    assert [line for line in lines if len(line) > width] == []


@pytest.mark.parametrize("document", [page for page in PAGES if page not in GENERATED])
def test_a_page_can_be_read_in_half_an_hour(document: str) -> None:
    assert len(read(document).split()) <= MOST_WORDS


def test_there_are_at_most_eighteen_pages_and_the_readme_leads_to_all() -> None:
    assert len({*PAGES} - LATER) <= 18
    assert [page for page in PAGES if f"({page})" not in read("README.md")] == []


@pytest.mark.parametrize("document", RESULTS)
def test_a_page_of_results_names_the_command_that_makes_it(document: str) -> None:
    assert re.search(r"^Made by `(make|python) ", read(document), re.MULTILINE)
