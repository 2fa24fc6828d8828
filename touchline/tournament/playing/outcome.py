"""How a planned match ended, as plain data that processes pass on and the store keeps."""

import json
from dataclasses import asdict, dataclass
from enum import StrEnum

from schemas.side import Side


class FailureKind(StrEnum):
    """Why a match was not played to its end."""

    DID_NOT_START = "did not start"
    CRASHED = "crashed"
    HUNG = "hung"
    BROKE_ACCESS_RULES = "broke the access rules"
    WORKER = "not played"
    """Through the fault of neither team: it is played again when the cup is resumed."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a match ended: with goals, or with a failure."""

    goals: tuple[int, int] = (0, 0)
    """Goals of cyan and magenta, as all pairs here."""
    penalties: tuple[int, int] | None = None
    yellows: tuple[int, int] = (0, 0)
    reds: tuple[int, int] = (0, 0)
    chain: str | None = None
    """The hash chain over all states."""
    failure: FailureKind | None = None
    culprit: Side | None = None
    """The side that is to blame for the failure; None for neither."""
    reason: str | None = None
    """One line on the failure."""

    @classmethod
    def failed(cls, kind: FailureKind, culprit: Side | None, reason: str) -> "Outcome":
        """A match that was not played to its end."""
        return cls(failure=kind, culprit=culprit, reason=" ".join(reason.split()))

    def to_json(self) -> str:
        """One JSON object."""
        return json.dumps(asdict(self), ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> "Outcome":
        """The outcome of `to_json`."""
        content = json.loads(text)
        for key in ("goals", "penalties", "yellows", "reds"):
            content[key] = tuple(content[key]) if content[key] is not None else None
        for key, kind in (("failure", FailureKind), ("culprit", Side)):
            content[key] = kind(content[key]) if content[key] is not None else None
        return cls(**content)
