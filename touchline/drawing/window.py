"""A window that shows pictures, one after the other."""

import numpy as np
from matplotlib import pyplot
from matplotlib.backend_bases import FigureManagerBase
from numpy.typing import NDArray

from schemas.errors import TouchlineError
from touchline.drawing.picture import DPI


class Window:
    """A window of the size of its pictures; it stays closed once its user has closed it."""

    def __init__(self, title: str, picture: NDArray[np.uint8]) -> None:
        """Open it with a picture, shape (height, width, 3).

        Raises:
            TouchlineError: there is no display.
        """
        height, width, _ = picture.shape
        self._figure = pyplot.figure(figsize=(width / DPI, height / DPI), dpi=DPI)
        manager = self._figure.canvas.manager
        if manager is None or type(manager).show is FigureManagerBase.show:
            self.close()
            raise TouchlineError(
                'render_mode is "human", but matplotlib opens no window here, '
                f'with its backend {pyplot.get_backend()}; give "rgb_array"'
            )
        manager.set_window_title(title)
        axes = self._figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_axis_off()
        self._image = axes.imshow(picture)
        manager.show()

    def show(self, picture: NDArray[np.uint8]) -> None:
        """Show another picture of the same shape."""
        if pyplot.fignum_exists(self._figure.number):
            self._image.set_data(picture)
            self._figure.canvas.draw()
            self._figure.canvas.flush_events()

    def close(self) -> None:
        """Close it."""
        pyplot.close(self._figure)
