"""Progress and control of a recorder while it records."""

from enum import StrEnum

from pydantic import Field

from schemas.wire.message import Message, Name, Source


class RecorderOperation(StrEnum):
    """What a recorder can do on request."""

    STATUS = "status"
    PAUSE = "pause"
    """Leave out what arrives from now on."""
    RESUME = "resume"
    SPLIT = "split"
    """Finish this file and continue in the next one."""
    SNAPSHOT = "snapshot"
    """Write the messages in memory to a file."""


class RecorderRequest(Message):
    """A request to a recorder."""

    operation: RecorderOperation = RecorderOperation.STATUS
    """What to do."""
    source: Source = "operator"
    """Name of the sender, for display."""


class RecorderReply(Message):
    """A recorder's reply, with its state after the request."""

    accepted: bool
    """The request was carried out."""
    reason: str = ""
    """Why it was refused; then nothing has changed."""
    recorder: Name
    """Name of the recorder."""
    paused: bool
    """The recorder is paused and leaves out what arrives."""
    file: str
    """Path of its file, on its own machine; the newest snapshot of a recorder that writes snapshots."""
    messages: int
    """Messages received so far."""
    lost: int
    """Messages known to be missing so far."""
    tick: int
    """The newest tick that it has received; −1 before the first."""


class RecorderProgress(Message):
    """Progress of a recorder; a lockstep host limits its lead over it."""

    tick: int
    """The newest tick of which the recorder has everything; −1 before the first."""
    messages: int
    """Messages received so far."""
    lost: int
    """Messages known to be missing so far."""
    losses: dict[str, int] = Field(default_factory=dict)
    """Key → messages known to be missing; keys without losses are left out."""
    sights: bool = False
    """The recorder also records sights: the host adds them to its batches."""
    paused: bool = False
    """The recorder is paused and leaves out what arrives."""
    leaving: bool = False
    """This is the recorder's last message: the host no longer waits for it."""
