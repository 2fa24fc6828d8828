"""Whether an operator has paused the match, and the tick at which it pauses next."""

from collections.abc import Callable

from schemas.messages.pace import PaceOperation, PaceReply, PaceRequest


class Pause:
    """Decides before each tick whether the host may compute it.

    Neither the agents' patience nor the watchdog counts during a pause: the tick's commands are there when it begins.
    """

    def __init__(self, tick: Callable[[], int], is_over: Callable[[], bool]) -> None:
        """`tick` returns the newest tick, and `is_over` whether the match has ended."""
        self._tick, self._is_over = tick, is_over
        self._until: int | None = None
        self._changes: list[str] = []

    @property
    def is_paused(self) -> bool:
        """Whether the next tick has to wait."""
        return self._until is not None and self._tick() >= self._until

    def handle(self, request: PaceRequest) -> PaceReply:
        """Pause, step or run, or refuse it with the reason."""
        reason = self._why_not(request)
        if not reason:
            self._change(request)
        return PaceReply(
            accepted=not reason, reason=reason, tick=self._tick(), paused=self.is_paused, until=self._until
        )

    def pop_changes(self) -> list[str]:
        """Pauses and their ends since the last call, as sentences; steps are none."""
        changes, self._changes = self._changes, []
        return changes

    def _why_not(self, request: PaceRequest) -> str:
        if request.operation is not PaceOperation.SHOW and self._is_over():
            return "the match is over"
        if request.operation is PaceOperation.STEP and not self.is_paused:
            return "the match is not paused; pause it first"
        return ""

    def _change(self, request: PaceRequest) -> None:
        before = self._until
        match request.operation:
            case PaceOperation.PAUSE:
                self._until = self._tick()
            case PaceOperation.STEP:
                self._until = self._tick() + request.ticks
            case PaceOperation.RUN:
                self._until = None
        if (before is None) is not (self._until is None):
            self._changes.append(
                f"{request.source} {'lets the match run' if before is not None else 'pauses the match'}"
            )
