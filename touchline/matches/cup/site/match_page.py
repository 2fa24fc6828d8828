"""The page of a match: replay, statistics and events from its recording, or the evidence for a forfeit."""

from html import escape
from pathlib import Path

from recordings.reading.recording import open_recording
from recordings.stats.page import page_of
from touchline.matches.cup.cup_state import CupMatch, Ended, MatchState
from touchline.matches.cup.site.links import score_text, team_link
from touchline.matches.cup.site.markup import link, page, section

_LONGEST_EVIDENCE = 20_000
"""Characters of evidence on a page, from its end."""


def match_page(match: CupMatch, folder: Path) -> str:
    """The page of a match that is over; `folder` is that of the cup.

    Raises:
        TouchlineError: its recording is damaged.
    """
    ended = match.ended
    assert ended is not None
    if ended.state is MatchState.PLAYED and ended.recording is not None:
        _, text = page_of(open_recording(folder / ended.recording), link("../index.html", "← all matches"))
        return text
    return _without_replay(match, ended, folder)


def _without_replay(match: CupMatch, ended: Ended, folder: Path) -> str:
    cyan, magenta = match.slot.sides
    score = score_text(ended.result, cyan) if ended.result is not None else "failed"
    facts = [("match", escape(match.slot.name)), ("identity", escape(ended.identity))]
    if ended.reason is not None:
        facts.insert(1, ("reason", escape(ended.reason)))
    if ended.result is not None and ended.result.forfeited_by is not None:
        facts.insert(1, ("forfeited by", team_link(ended.result.forfeited_by, "../")))
    if ended.recording is not None:
        facts.append(("recording", link(f"../{ended.recording}", ended.recording)))
    if ended.evidence is not None:
        facts.append(("evidence", link(f"../{ended.evidence}", ended.evidence)))
    listed = "".join(f"<dt>{name}</dt><dd>{value}</dd>" for name, value in facts)
    body = (
        f"<header><h1>{escape(cyan)} {score} {escape(magenta)}</h1></header>\n<main>"
        + section("The match", f'<dl class="facts">{listed}</dl>{_evidence(ended, folder)}')
        + "</main>"
    )
    return page(f"{cyan} – {magenta}", body, up="../")


def _evidence(ended: Ended, folder: Path) -> str:
    """The text of the evidence: that of a file, or the ends of all logs of a folder."""
    if ended.evidence is None:
        return ""
    path = folder / ended.evidence
    files = [path] if path.is_file() else sorted(one for one in path.rglob("*.log") if one.is_file())
    parts = []
    for file in files:
        text = file.read_text("utf-8", "replace").strip()
        if text:
            name = "" if file == path else f"<h3>{escape(str(file.relative_to(path)))}</h3>"
            parts.append(f"{name}<pre>{escape(text[-_LONGEST_EVIDENCE:])}</pre>")
    return "".join(parts)
