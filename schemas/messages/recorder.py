"""Progress of a recorder while it records."""

from schemas.wire.message import Message


class RecorderProgress(Message):
    """Progress of a recorder; a lockstep host limits its lead over it."""

    tick: int
    """The newest tick of which the recorder has everything; −1 before the first."""
    messages: int
    """Messages received so far."""
    lost: int
    """Messages known to be missing so far."""
    losses: dict[str, int] = {}
    """Key → messages known to be missing; keys without losses are left out."""
    sights: bool = False
    """The recorder also records sights: the host adds them to its batches."""
    leaving: bool = False
    """This is the recorder's last message: the host no longer waits for it."""
