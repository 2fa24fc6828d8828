"""A page of a match as one HTML file that opens from disk, without a network.

`content` collects its data. The scripts in this folder are plain modules that are joined to one script when the page is
written, so that no build step is needed.
"""

import re
from importlib import resources
from pathlib import Path
from typing import Any

from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from recordings.reading.recording import Recording
from recordings.soccer.stats.figures import MatchFigures
from recordings.soccer.stats.match_statistics import figures_of_recording
from recordings.soccer.stats.page.content import content_of
from recordings.soccer.stats.page.game_history import GameHistory
from recordings.soccer.stats.tracks import Tracks
from schemas.errors import os_errors

SCRIPTS = (
    "shared/elements.js",
    "shared/projection.js",
    "shared/palette.js",
    "shared/shapes.js",
    "shared/pitch.js",
    "shared/bodies.js",
    "shared/events.js",
    "match.js",
    "canvas.js",
    "moving_bodies.js",
    "player.js",
    "keys.js",
    "timeline.js",
    "event_list.js",
    "heat_maps.js",
    "shots.js",
    "main.js",
)
"""Each imports only from those before it; those in `shared` are of `schemas/page`, which the match's page uses too."""


def page_of(recording: Recording, navigation: str = "") -> tuple[MatchFigures, str]:
    """Return the figures of a recording, and its page as HTML; `navigation` is HTML above it, such as a link.

    Raises:
        TouchlineError: the recording is damaged inside, or has no setup or no world.
    """
    setup = recording.setup
    tracks, history = Tracks(setup, *recording.extent_of_worlds()), GameHistory()
    figures = figures_of_recording(recording, tracks.update, history.update)
    return figures, page(content_of(recording.manifest, setup, figures, tracks, history), navigation)


def page(content: dict[str, Any], navigation: str = "") -> str:
    """Return the page with this content, as HTML; `navigation` is HTML above it."""
    environment = Environment(autoescape=True, undefined=StrictUndefined, keep_trailing_newline=True)
    environment.policies["json.dumps_kwargs"] = {"ensure_ascii": False, "separators": (",", ":"), "allow_nan": False}
    return environment.from_string(_text("page.html")).render(
        content=content,
        navigation=Markup(navigation),
        style=Markup(_text("page.css")),
        script=Markup("\n".join(_inlined(_text(name)) for name in SCRIPTS)),
    )


def write_page(path: Path, text: str) -> None:
    """Write a page to disk.

    Raises:
        TouchlineError: the file cannot be written.
    """
    with os_errors(f"--html {path}", "give a path that can be written"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")


def _text(name: str) -> str:
    folder, _, file = name.rpartition("/")
    files = resources.files("schemas") / "page" if folder == "shared" else resources.files(__package__ or __name__)
    return (files / file).read_text("utf-8")


def _inlined(module: str) -> str:
    """Remove imports and exports of a module: in the joined script its imports precede it."""
    return re.sub(r"^export ", "", re.sub(r"^import .*;\n", "", module, flags=re.MULTILINE), flags=re.MULTILINE)
