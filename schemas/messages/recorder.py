"""Controls a recorder while it records: asked of it by name, answered at once."""

from enum import StrEnum

from schemas.message import Message, Name, Source


class RecorderOperation(StrEnum):
    """What a recorder is asked to do."""

    STATUS = "status"
    PAUSE = "pause"
    """Leave out what comes from now on."""
    RESUME = "resume"
    SPLIT = "split"
    """Finish this file and go on in the next one."""
    SNAPSHOT = "snapshot"
    """Write what it holds in memory to a file."""


class RecorderRequest(Message):
    """Asks a recorder to do something, or how it is doing."""

    operation: RecorderOperation = RecorderOperation.STATUS
    """What the recorder is asked to do."""
    source: Source = "operator"
    """Who asks."""


class RecorderReply(Message):
    """A recorder's answer: how it is doing after what it was asked."""

    accepted: bool
    """The recorder did what it was asked to do."""
    reason: str = ""
    """Why it was refused; then nothing has changed."""
    recorder: Name
    """Name of the recorder."""
    paused: bool
    """The recorder leaves out what comes."""
    file: str
    """Path of the file that it writes, on its own machine; with snapshots, the newest of them."""
    messages: int
    """Messages taken in so far."""
    lost: int
    """Messages known to be missing so far."""
    tick: int
    """The newest tick that it has taken in; −1 before the first."""
