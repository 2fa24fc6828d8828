"""Pictures of a match from its recording: moments with the way that led there, and the ball's way over the match.

Needs matplotlib, which is imported only when something is drawn.
"""

from pathlib import Path

from schemas.errors import TouchlineError


def draw(path: Path, out: Path, times: list[float] | None = None) -> None:
    """Draw a match at these simulated times in s, one panel each, by default at its last moment of play; PNG or SVG.

    Raises:
        TouchlineError: matplotlib is missing, nothing was recorded at a time, or `out` is no picture's name.
    """
    _need_matplotlib()
    from recordings.picture.bodies import draw_bodies
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.sheet import Sheet
    from recordings.picture.story import Story

    story = Story(path)
    moments = [story.moment(time) for time in (times or [story.last_play()])]
    sheet = Sheet(story, [moment.now.time for moment in moments])
    for panel, moment in zip(sheet.panels, moments, strict=True):
        draw_pitch(panel, story.setup.pitch)
        draw_bodies(panel, story.setup, moment.worlds, sheet.inches_per_metre)
    sheet.title([moment.words for moment in moments], moments[-1].score)
    sheet.save(out)


def trace(path: Path, out: Path) -> None:
    """Draw where the ball was while it was in play: the longer at a place, the brighter; goals as rings.

    Raises:
        TouchlineError: as `draw`.
    """
    _need_matplotlib()
    from recordings.picture.heat import draw_goals, draw_heat
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.sheet import Sheet
    from recordings.picture.story import Story

    story = Story(path)
    worlds = story.in_play()
    sheet = Sheet(story, [story.end])
    (panel,) = sheet.panels
    draw_pitch(panel, story.setup.pitch)
    draw_heat(panel, story.setup.pitch, worlds)
    draw_goals(panel, story.goals)
    sheet.title([f"way of the ball in {len(worlds) * story.setup.time.tick:.0f} s of play"], story.score_at(story.end))
    sheet.save(out)


def _need_matplotlib() -> None:
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        raise TouchlineError("pictures need matplotlib; run: pip install touchline[viz]") from None
