"""Admission by an operator: of recorders that the host waits for."""

from schemas.wire.message import Message, Name, Source


class AdmissionRequest(Message):
    """A request to admit a recorder."""

    recorder: Name
    """Name of a recorder that a lockstep host waits for from now on."""
    source: Source = "operator"
    """Name of the sender, for display."""


class AdmissionReply(Message):
    """The host's reply."""

    accepted: bool
    """The request was carried out."""
