"""The pages of a cup: a folder that opens from disk; each page is written when it changes."""

import hashlib
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from markupsafe import Markup

from recordings.reading.recording import open_recording
from recordings.soccer.stats import page as statistics_page
from runtime.process.whole_file import written_whole
from touchline.matches.cup.cup_config import TeamEntry
from touchline.matches.cup.cup_state import CupMatch, CupState, Ended, MatchState, Slot
from touchline.matches.cup.formats.knock_out import name_of, stage_of
from touchline.matches.cup.match_result import score_text, scored
from touchline.matches.cup.standings import Standing
from touchline.matches.report import page_of, part_of
from touchline.matches.statistics.ratings import Ratings, rate
from touchline.timing import STATUS_S

_LONGEST_EVIDENCE = 20_000
"""Characters of evidence on a page, from its end."""


class Site:
    """The pages of a cup; a page is replaced as a whole, so that no reader sees half of one."""

    def __init__(self, folder: Path, digests: Mapping[str, str | None]) -> None:
        """`folder` is the cup's; `digests` are of the teams' files."""
        self._folder = folder
        self._digests = digests
        self._written: dict[str, str] = {}

    def write(self, state: CupState, *, running: bool) -> None:
        """Write what has changed. A running cup's pages load themselves again.

        Raises:
            TouchlineError: the recording of a match is damaged.
        """
        rated = rate(state.cup.names, scored(state.results))
        for match in state.matches:
            address = match_address(match.slot)
            if match.state is MatchState.DUE:
                (self._folder / address).unlink(missing_ok=True)  # of a failure after which it is played again
            elif not (self._folder / address).exists():
                self._put(address, _match_page(match, self._folder))
        for team in state.cup.teams:
            page = _team_page(state, team, self._digests.get(team.name), rated, running=running)
            self._put(team_address(team.name), page)
        self._put("index.html", _index_page(state, rated, running=running))

    def _put(self, address: str, text: str) -> None:
        if self._written.get(address) == text:
            return
        path = self._folder / address
        path.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(path) as draft:
            draft.write_text(text, "utf-8")
        if not address.startswith("matches/"):
            self._written[address] = text


def match_address(slot: Slot) -> str:
    """The page of a match, from the folder of the cup."""
    return f"matches/{slot.file_name}.html"


def team_address(team: str) -> str:
    """The page of a team; names that differ in their signs only have different pages."""
    plain = re.sub(r"\W+", "_", team.lower(), flags=re.ASCII).strip("_")
    return f"teams/{plain or 'team'}_{hashlib.blake2b(team.encode(), digest_size=3).hexdigest()}.html"


def signed(value: float) -> str:
    """A whole number with its sign; 0 has none."""
    whole = round(value)
    return f"+{whole}" if whole > 0 else f"−{-whole}" if whole < 0 else "0"


def standings(rows: Sequence[Standing]) -> str:
    """The table of a league, a group or a Swiss tournament, as it stands in the first page."""
    return part_of("cup/parts.html", "standings", rows, **_functions())


def _page(template: str, title: str, *, running: bool = False, **values: Any) -> str:
    return page_of(f"cup/{template}", title=title, running=running, refresh_s=STATUS_S, **_functions(), **values)


def _functions() -> dict[str, Any]:
    """Name → function that templates call."""
    functions = (decided, enumerate, match_address, name_of, program, score_text, signed, stage_of, team_address)
    return {one.__name__: one for one in functions}


def _index_page(state: CupState, rated: Ratings, *, running: bool) -> str:
    """Where the cup stands, tables, bracket, ratings, and all matches."""
    over = sum(one.state is not MatchState.DUE for one in state.matches)
    title = state.cup.title or state.cup.name
    return _page("index.html", title, running=running, state=state, rated=rated, over=over)


def _team_page(state: CupState, team: TeamEntry, digest: str | None, rated: Ratings, *, running: bool) -> str:
    """What a team is, how it stands, and its matches; `digest` is that of its files."""
    rows = [("program", program(team)), ("version", team.version), ("digest of its files", digest or "")]
    for stage, standings in state.schedule.tables.items():
        row = next((one for one in standings if one.team == team.name), None)
        if row is not None:
            rows.append((stage, f"place {row.place} of {len(standings)}, {row.points} points"))
    rating = next((one for one in rated.teams if one.team == team.name), None)
    if rating is not None and rating.matches:
        rows.append(("rating", f"{signed(rating.value)} ({signed(rating.low)} to {signed(rating.high)})"))
    played = [one for one in state.matches if team.name in one.slot.fixture.teams]
    return _page("team.html", team.name, running=running, rows=rows, played=played)


def _match_page(match: CupMatch, folder: Path) -> str:
    """Replay, statistics and events of a match that is over, or the evidence for a forfeit.

    Raises:
        TouchlineError: its recording is damaged.
    """
    ended, sides = match.ended, match.slot.sides
    assert ended is not None
    if ended.state is MatchState.PLAYED and ended.recording is not None:
        home = Markup('<a href="../index.html">← all matches</a>')
        _, text = statistics_page.page_of(open_recording(folder / ended.recording), home)
        return text
    title, evidence = f"{sides[0]} – {sides[1]}", _evidence(ended, folder)
    return _page("match.html", title, name=match.slot.name, sides=sides, ended=ended, evidence=evidence)


def _evidence(ended: Ended, folder: Path) -> list[tuple[str, str]]:
    """File → text: one file without a name, or all logs of a folder that have any."""
    if ended.evidence is None:
        return []
    path = folder / ended.evidence
    files = [path] if path.is_file() else sorted(one for one in path.rglob("*.log") if one.is_file())
    texts = [
        ("" if file == path else str(file.relative_to(path)), file.read_text("utf-8", "replace")) for file in files
    ]
    return [(name, text.strip()[-_LONGEST_EVIDENCE:]) for name, text in texts if text.strip()]


def decided(rows: Sequence[Standing]) -> list[str]:
    """What decided between teams of as many points."""
    return [
        f"{row.team} before {below.team} by {row.decided_by}"
        for row, below in pairwise(rows)
        if row.decided_by is not None and row.played and below.played
    ]


def program(team: TeamEntry) -> str:
    """The brain of a team, or the command line of its program."""
    return team.brain or " ".join(team.command or team.stdio or [])
