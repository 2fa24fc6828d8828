"""What waits to be sent to one page: all that was said, and of the frames the newest alone."""

import asyncio
from collections import deque

MOST = 5000
"""Messages that may wait for a page; one that lets more pile up does not read."""


class SendQueue:
    """Filled at once, emptied as fast as the page reads."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._frame: str | None = None
        self._filled = asyncio.Event()
        self.skipped = 0
        """Frames that were replaced before the page had read them."""

    @property
    def overflows(self) -> bool:
        """More waits than a page that reads would let pile up."""
        return len(self._messages) > MOST

    def put(self, text: str) -> None:
        """One message, kept until it is sent."""
        self._messages.append(text)
        self._filled.set()

    def put_frame(self, frame: str) -> None:
        """A frame, in place of one that still waits."""
        self.skipped += self._frame is not None
        self._frame = frame
        self._filled.set()

    def restart(self, welcome: str) -> None:
        """Something new begins: the frame that waits is void. Answers that wait are not."""
        self._frame = None
        self.put(welcome)

    async def next(self) -> str:
        """What to send next: what was said first, then the frame."""
        while not self._messages and self._frame is None:
            self._filled.clear()
            await self._filled.wait()
        if self._messages:
            return self._messages.popleft()
        frame, self._frame = self._frame, None
        assert frame is not None
        return frame
