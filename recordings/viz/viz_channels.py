"""Writes the drawing of a match into its recording, in channels for viewers.

These channels are derived: readers of this project ignore them, and copies of a recording are drawn again.
"""

from mcap.writer import Writer

from recordings.container.mcap_file import DERIVED
from recordings.viz.drawing import Drawing, schema_of
from recordings.viz.foxglove import descriptors
from runtime.bus.contract import ReceivedMessage
from schemas.messages.setup import Setup


class VizChannels:
    """Draws the messages that are written to a file into the same file."""

    def __init__(self, mcap: Writer, setup: Setup) -> None:
        self._mcap, self._drawing = mcap, Drawing(setup)
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._numbers: dict[str, int] = {}

    def draw(self, received: ReceivedMessage, log_ns: int) -> None:
        """Write the messages for viewers that follow from this one, with its times."""
        for topic, payload in self._drawing.draw(received, log_ns):
            channel = self._channels.get(topic) or self._open(topic)
            number = self._numbers[topic] = self._numbers.get(topic, -1) + 1
            sent_ns = received.stamp.sent_ns if received.stamp is not None else log_ns
            self._mcap.add_message(channel, log_ns, payload, sent_ns, number)

    def _open(self, topic: str) -> int:
        message = schema_of(topic)
        if message not in self._schemas:
            self._schemas[message] = self._mcap.register_schema(message, "protobuf", descriptors(message))
        metadata = {DERIVED: "from world, game/state, game/event, host/applied and team/*/debug/*"}
        channel = self._mcap.register_channel(topic, "protobuf", self._schemas[message], metadata)
        self._channels[topic] = channel
        return channel
