"""The progress of a replay in one line."""

from coach_gateway.match.lines import clock_text
from schemas.messages.replay import ReplayReply

_CELLS = 40
"""Width of the bar."""


def status_text(status: ReplayReply) -> str:
    """A status as text: `0:24.7 of 0:28.0  ×2  paused  loop`."""
    speed = "as fast as possible" if status.rate is None else f"×{status.rate:g}"
    parts = [f"{clock_text(status.time)} of {clock_text(status.end)}", speed]
    return "  ".join([*parts, *(name for name, is_on in (("paused", status.paused), ("loop", status.loop)) if is_on)])


def bar_text(status: ReplayReply) -> str:
    """The same behind a bar, for a terminal."""
    share = (status.time - status.start) / max(status.end - status.start, 1e-9)
    done = round(_CELLS * min(1.0, max(0.0, share)))
    return f"{'━' * done}{'╌' * (_CELLS - done)}  {status_text(status)}"
