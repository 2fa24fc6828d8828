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
    from recordings.picture.picture_data import PictureData
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.sheet import Sheet

    data = PictureData(path)
    panels_data = [data.panel_data(time) for time in (times or [data.last_play()])]
    sheet = Sheet(data, [panel_data.now.time for panel_data in panels_data])
    for panel, panel_data in zip(sheet.panels, panels_data, strict=True):
        draw_pitch(panel, data.setup.pitch)
        draw_bodies(panel, data.setup, panel_data.worlds, sheet.inches_per_metre)
    sheet.title([panel_data.caption for panel_data in panels_data], panels_data[-1].score)
    sheet.save(out)


def trace(path: Path, out: Path) -> None:
    """Draw where the ball was while it was in play: the longer at a place, the brighter; goals as rings.

    Raises:
        TouchlineError: as `draw`.
    """
    _need_matplotlib()
    from recordings.picture.heat_map import draw_goals, draw_heat
    from recordings.picture.picture_data import PictureData
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.sheet import Sheet

    data = PictureData(path)
    worlds = data.in_play()
    sheet = Sheet(data, [data.end])
    (panel,) = sheet.panels
    draw_pitch(panel, data.setup.pitch)
    draw_heat(panel, data.setup.pitch, worlds)
    draw_goals(panel, data.goals)
    sheet.title([f"way of the ball in {len(worlds) * data.setup.time.tick:.0f} s of play"], data.score_at(data.end))
    sheet.save(out)


def _need_matplotlib() -> None:
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        raise TouchlineError("pictures need matplotlib; run: pip install touchline[viz]") from None
