"""Admission by an operator or a referee: of recorders that the host waits for, and of accounts that were cut off."""

from typing import Annotated

from pydantic import Field, model_validator

from schemas.wire.message import Message, Name, Source


class AdmissionRequest(Message):
    """A request to admit a recorder or an account; without either, it lists the accounts that are cut off."""

    recorder: Name | None = None
    """Name of a recorder that a lockstep host waits for from now on."""
    account: Annotated[str, Field(max_length=200)] | None = None
    """An account that was cut off, or its key on a host without credentials: its messages are read again."""
    source: Source = "operator"
    """Name of the sender, for display."""

    @model_validator(mode="after")
    def _names_one(self) -> "AdmissionRequest":
        if self.recorder is not None and self.account is not None:
            raise ValueError("recorder and account are both given; a request admits one of them")
        return self


class AdmissionReply(Message):
    """The host's reply."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    cut_off: list[str] = Field(default_factory=list)
    """Accounts that are cut off."""
