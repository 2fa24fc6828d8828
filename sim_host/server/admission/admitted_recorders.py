"""Whom the host admits: the recorders that it waits for."""

from collections.abc import Iterable

from schemas.messages.admission import AdmissionReply, AdmissionRequest

MOST_UNNAMED = 4
"""Recorders with credentials, besides the named ones, that a host waits for: each that reports nothing holds the match
for its patience, and one account may declare any number of names."""


class AdmittedRecorders:
    """Recorders that a lockstep host waits for. Every other recorder is served, and may fall behind."""

    def __init__(self, recorders: Iterable[str], *, any_recorder: bool = False) -> None:
        """With `any_recorder` the first few are admitted that join, since the host asks for credentials."""
        self._recorders = set(recorders)
        self._any_recorder = any_recorder
        self._unnamed: set[str] = set()
        self._is_full = False
        self._changes: list[str] = []

    def waits_for(self, recorder: str) -> bool:
        """Whether a lockstep host waits for a recorder of this name."""
        return recorder in self._recorders or recorder in self._unnamed

    def join(self, recorder: str) -> None:
        """Admit a recorder that is present, where that takes credentials; its place is not given to another one."""
        if not self._any_recorder or self._is_full or self.waits_for(recorder):
            return
        if len(self._unnamed) < MOST_UNNAMED:
            self._unnamed.add(recorder)
            return
        self._is_full = True
        names = ", ".join(sorted(self._unnamed))
        self._changes.append(
            f"the host does not wait for {recorder} and later recorders: {names} have joined before; "
            f"`touchline referee admit-recorder --name {recorder}` makes it wait"
        )

    def handle(self, request: AdmissionRequest) -> AdmissionReply:
        """Admit the recorder that the request names."""
        if not self.waits_for(request.recorder):
            self._recorders.add(request.recorder)
            self._changes.append(f"the host waits for the recorder {request.recorder} ({request.source})")
        return AdmissionReply(accepted=True)

    def pop_changes(self) -> list[str]:
        """What has been admitted since the last call, one line each."""
        changes, self._changes = self._changes, []
        return changes
