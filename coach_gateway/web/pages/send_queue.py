"""What waits to be sent to one page: all messages, and of the frames the newest alone."""

import asyncio
from collections import deque

MOST = 5000
"""Messages that may wait for a page; a page with more does not read."""


class SendQueue:
    """Filled without waiting, emptied as fast as the page reads."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._frame: str | None = None
        self._filled = asyncio.Event()
        self.overflowed = asyncio.Event()
        """Set once more messages have waited than for a page that reads."""

    def put(self, text: str) -> None:
        """Add a message, which is kept until it is sent."""
        if len(self._messages) >= MOST:
            self.overflowed.set()
            return
        self._messages.append(text)
        self._filled.set()

    def put_frame(self, frame: str) -> None:
        """Add a frame, in place of one that still waits."""
        self._frame = frame
        self._filled.set()

    def restart(self, welcome: str) -> None:
        """Add a welcome: a waiting frame is void from here on, waiting replies are not."""
        self._frame = None
        self.put(welcome)

    async def next(self) -> str:
        """What to send next: messages in order, then the frame."""
        while not self._messages and self._frame is None:
            self._filled.clear()
            await self._filled.wait()
        if self._messages:
            return self._messages.popleft()
        frame, self._frame = self._frame, None
        assert frame is not None
        return frame
