"""Parts of HTML that all pages of a cup have."""

from collections.abc import Iterable, Sequence
from html import escape
from importlib import resources

REFRESH_S = 4
"""Seconds after which a page of a running cup loads itself again."""


def page(title: str, body: str, *, up: str = "", running: bool = False) -> str:
    """A whole page; `up` is the path from its folder to that of the cup."""
    refresh = f'<meta http-equiv="refresh" content="{REFRESH_S}">\n' if running else ""
    home = f'<nav><a href="{up}index.html">← all matches</a></nav>\n' if up else ""
    style = (resources.files(__package__ or __name__) / "site.css").read_text("utf-8")
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
        f'<meta name="color-scheme" content="light dark">\n{refresh}'
        f"<title>{escape(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>\n{home}{body}\n</body>\n</html>\n"
    )


def section(heading: str, content: str, kind: str = "") -> str:
    """A part of a page; empty content leaves it out."""
    return f'<section class="{kind}">\n<h2>{escape(heading)}</h2>\n{content}\n</section>\n' if content else ""


def link(target: str, text: str) -> str:
    """A link to another page of the cup."""
    return f'<a href="{escape(target)}">{escape(text)}</a>'


def table(headings: Sequence[str], rows: Iterable[Sequence[str]], kind: str = "", titles: Sequence[str] = ()) -> str:
    """A table; headings are text, cells are HTML. A wide table scrolls within the page."""
    explained = [*titles, *[""] * (len(headings) - len(titles))]
    head = "".join(
        f'<th scope="col" title="{escape(title)}">{escape(one)}</th>'
        if title
        else f'<th scope="col">{escape(one)}</th>'
        for one, title in zip(headings, explained, strict=True)
    )
    lines = "\n".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return (
        f'<div class="scroll" tabindex="0" role="region"><table class="{kind}">\n'
        f"<thead><tr>{head}</tr></thead>\n<tbody>\n{lines}\n</tbody></table></div>"
    )
