"""Writes the pages of a cup into its folder: those that change with each result, and each match's once."""

from collections.abc import Mapping
from pathlib import Path

from touchline.matches.cup.cup_state import CupState, MatchState
from touchline.matches.cup.ratings import is_available, rate
from touchline.matches.cup.site.index_page import index_page
from touchline.matches.cup.site.links import match_address, team_address
from touchline.matches.cup.site.match_page import match_page
from touchline.matches.cup.site.team_page import team_page


class Site:
    """The pages of a cup; a page is replaced as a whole, so that no reader sees half of one."""

    def __init__(self, folder: Path, digests: Mapping[str, str | None]) -> None:
        """`folder` is that of the cup; `digests` are those of the teams' files."""
        self._folder = folder
        self._digests = digests
        self._written: dict[str, str] = {}

    def write(self, state: CupState, *, running: bool) -> None:
        """Write what has changed. A running cup's pages load themselves again.

        Raises:
            TouchlineError: the recording of a match is damaged.
        """
        rated = rate(state.cup.names, state.results) if is_available() else None
        for match in state.matches:
            address = match_address(match.slot)
            if match.state is MatchState.DUE:
                (self._folder / address).unlink(missing_ok=True)  # of a failure after which it is played again
            elif not (self._folder / address).exists():
                self._put(address, match_page(match, self._folder))
        for team in state.cup.teams:
            digest = self._digests.get(team.name)
            self._put(team_address(team.name), team_page(state, team, digest, rated, running=running))
        self._put("index.html", index_page(state, rated, running=running))

    def _put(self, address: str, text: str) -> None:
        if self._written.get(address) == text:
            return
        path = self._folder / address
        path.parent.mkdir(parents=True, exist_ok=True)
        draft = path.with_suffix(".part")
        draft.write_text(text, "utf-8")
        draft.replace(path)
        if not address.startswith("matches/"):
            self._written[address] = text
