"""Lines in a stream of bytes, with a limit of their length: no output of a program fills the memory."""

from typing import NamedTuple


class Line(NamedTuple):
    """One line of output, without its line break."""

    content: bytes
    is_cut: bool = False
    """It is longer than the limit, and this is its beginning."""


class LineSplitter:
    """Collects bytes, and gives them line by line."""

    def __init__(self, longest: int) -> None:
        """`longest` is the length in bytes beyond which a line is cut."""
        self._longest = longest
        self._begun = b""
        self._is_discarding = False
        """The rest of a line that was cut is being left out."""

    def feed(self, data: bytes) -> list[Line]:
        """The lines that are complete with these bytes; a line that is cut counts as complete at once."""
        lines = []
        *ended, rest = (self._begun + data).split(b"\n")
        for content in ended:
            if not self._is_discarding:
                lines.append(self._line(content))
            self._is_discarding = False
        if self._is_discarding:
            rest = b""
        elif len(rest) > self._longest:
            lines.append(self._line(rest))
            self._is_discarding, rest = True, b""
        self._begun = rest
        return lines

    def _line(self, content: bytes) -> Line:
        return Line(content[: self._longest], len(content) > self._longest)
