"""Pictures of a match from its recording: single moments with trails, and a heat map of the ball.

They require matplotlib, which is imported only when a picture is drawn.
"""

from pathlib import Path

from schemas.errors import TouchlineError


def draw(path: Path, out: Path, times: list[float] | None = None) -> None:
    """Draw a match at these simulated times in s, one panel each, by default at the end of play; as PNG or SVG.

    Raises:
        TouchlineError: matplotlib is missing, a time was not recorded, or `out` does not end in `.png` or `.svg`.
    """
    _need_matplotlib()
    from recordings.picture.bodies import draw_bodies
    from recordings.picture.picture_data import PictureData
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.readings import draw_readings
    from recordings.picture.sheet import Sheet

    data = PictureData(path)
    panels_data = [data.panel_data(time) for time in (times or [data.last_play()])]
    sheet = Sheet(data, [panel_data.now.time for panel_data in panels_data])
    for panel, panel_data in zip(sheet.panels, panels_data, strict=True):
        draw_pitch(panel, data.setup.pitch)
        draw_bodies(panel, data.setup, panel_data.worlds, sheet.inches_per_metre)
        draw_readings(panel, data.setup, panel_data.worlds, sheet.inches_per_metre)
    sheet.title([panel_data.caption for panel_data in panels_data], panels_data[-1].score)
    sheet.save(out)


def trace(path: Path, out: Path) -> None:
    """Draw a heat map of the ball while it was in play, and a ring for each goal.

    Raises:
        TouchlineError: as for `draw`.
    """
    _need_matplotlib()
    from recordings.picture.picture_data import PictureData
    from recordings.picture.pitch import draw_pitch
    from recordings.picture.sheet import Sheet
    from recordings.picture.soccer import draw_goals, draw_heat

    data = PictureData(path)
    worlds = data.in_play()
    sheet = Sheet(data, [data.end])
    (panel,) = sheet.panels
    draw_pitch(panel, data.setup.pitch)
    draw_heat(panel, data.setup.pitch, worlds)
    draw_goals(panel, data.goals)
    sheet.title([f"path of the ball in {len(worlds) * data.setup.time.tick:.0f} s of play"], data.score_at(data.end))
    sheet.save(out)


def _need_matplotlib() -> None:
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        raise TouchlineError("pictures require matplotlib; run: pip install 'touchline[viz]'") from None
