"""How a process has ended, in words."""

import signal

_NAMES = {one.value: one.name for one in signal.Signals}
"""Real-time signals have none but the first and the last."""


def ending(status: int) -> str:
    """How a process with this exit status has ended: `ended with status 3`, `was ended by SIGKILL` where negative."""
    return f"ended with status {status}" if status >= 0 else f"was ended by {_NAMES.get(-status, f'signal {-status}')}"
