"""A backend of matplotlib that stands for one with windows: it notes what it is asked to show and to draw."""

from collections.abc import Iterator
from contextlib import contextmanager
from zlib import crc32

from matplotlib import pyplot
from matplotlib.backend_bases import FigureManagerBase
from matplotlib.backends.backend_agg import FigureCanvasAgg

shown: list[str] = []
"""Titles of the windows that were opened."""
drawn: list[int] = []
"""A checksum of each picture that was drawn."""


class Manager(FigureManagerBase):
    """Opens no window, but says so."""

    title = ""

    def set_window_title(self, title: str) -> None:
        """Note it."""
        self.title = title

    def show(self) -> None:
        """Note the title."""
        shown.append(self.title)


class FigureCanvas(FigureCanvasAgg):
    """Draws into memory."""

    manager_class = Manager

    def draw(self) -> None:
        """Note what was drawn."""
        super().draw()
        drawn.append(crc32(self.buffer_rgba()))


@contextmanager
def backend(name: str) -> Iterator[None]:
    """Let matplotlib use a backend; all windows are closed before it gets its own again."""
    before = pyplot.get_backend()
    pyplot.switch_backend(name)
    shown.clear()
    drawn.clear()
    try:
        yield
    finally:
        pyplot.close("all")
        pyplot.switch_backend(before)
