"""Replays MCAP files of any writer: their messages on keys named like their topics, at log time."""

from collections.abc import Callable, Sequence

from recordings.container.encodings import zenoh_encoding
from recordings.container.mcap_file import ChannelRecord
from recordings.reading.log_order import Log, LogMessage
from recordings.replay.host import ReplayLoop
from recordings.replay.log_cursor import LogCursor
from recordings.replay.playback_clock import AS_FAST_AS_POSSIBLE
from recordings.replay.player import PlaybackRange, Player
from recordings.replay.replay import ReplaySettings
from recordings.replay.seek_targets import seconds_in
from runtime.bus.contract import BusError, PresenceKind
from runtime.bus.zenoh.any_keys import KeyPublisher, check_key
from runtime.bus.zenoh.bus import ZenohBus
from schemas.errors import TouchlineError
from schemas.messages.replay import ReplayTopic


class Keys:
    """The keys of topics: without a leading `/`, selected, renamed, and below a prefix."""

    def __init__(self, settings: ReplaySettings, rename: Sequence[str] = (), prefix: str = "") -> None:
        """`rename` has texts as `OLD=NEW`: a key, or the chunks at the beginning of keys.

        Raises:
            TouchlineError: a text is none of these.
        """
        self._names: dict[str, str] = {}  # key → that of its topic
        self._selection = settings.selection
        self._prefix = prefix.rstrip("/") + "/" if prefix else ""
        self._renamed: dict[str, str] = {}
        for text in rename:
            old, sign, new = text.partition("=")
            if not old.strip("/") or not sign or not new.strip("/"):
                raise TouchlineError(f'--rename is "{text}"; write the old and the new key: robot1/odom=robot2/odom')
            self._renamed[old.strip("/")] = new.strip("/")
        self.unused = set(self._renamed)
        """Old keys that no topic has had so far."""

    def of(self, topic: str) -> str | None:
        """The key of a topic; None for one that is not selected.

        Raises:
            TouchlineError: it cannot be a key, or is that of another topic, too.
        """
        if (name := self._selection.key_of(topic)) is None:
            return None
        old = next((one for one in self._renamed if f"{name}/".startswith(f"{one}/")), "")
        self.unused.discard(old)
        key = self._renamed.get(old, "") + name[len(old) :]
        if (other := self._names.setdefault(key, name)) != name:
            raise TouchlineError(f"--rename: {other} and {name} are both {key}; leave one out with --exclude")
        key = self._prefix + key
        try:
            check_key(key)
        except BusError as error:
            raise BusError(f"topic {topic}: {error}; leave it out with --exclude, or give --rename") from None
        return key


class LogReplay(ReplayLoop):
    """Plays a log on a network of Zenoh."""

    def __init__(
        self, bus: ZenohBus, log: Log, settings: ReplaySettings, show: Callable[[LogMessage], None] = lambda _: None
    ) -> None:
        """`settings.start` and `settings.end` are in s since the first message; `show` gets all that is published.

        Raises:
            TouchlineError: a time is no number, or is beyond the end.
        """
        super().__init__(bus)
        self._bus, self._show = bus, show
        self._publishers: dict[tuple[str, str], KeyPublisher] = {}
        self._of_channel: dict[tuple[str, int], KeyPublisher] = {}
        bus.declare_alive(PresenceKind.REPLAY, "replay")
        self.player = Player(
            LogCursor(log),
            bus.clock,
            self._publish,
            span_of(settings, log.end_ns),
            rate=AS_FAST_AS_POSSIBLE if settings.rate is None else settings.rate,
            paused=settings.paused,
            loop=settings.loop,
            stay=settings.stay,
            time_of=seconds,
            topics=topics_of(log),
        )

    def _publish(self, message: LogMessage) -> None:
        key = message.key, id(message.topic)
        if (publisher := self._of_channel.get(key)) is None:
            publisher = self._of_channel[key] = self._publisher(message.key, message.topic)
        publisher.put(message.payload)
        self._show(message)

    def _publisher(self, key: str, channel: ChannelRecord) -> KeyPublisher:
        """One for each key and encoding, which channels of several files share."""
        encoding = zenoh_encoding(channel)
        if (key, encoding) not in self._publishers:
            self._publishers[key, encoding] = KeyPublisher(self._bus, key, encoding)
        return self._publishers[key, encoding]


def topics_of(log: Log) -> list[ReplayTopic]:
    """The topics of a log that have messages, by key."""
    return [
        ReplayTopic(
            key=key,
            encoding=one.encoding,
            schema=one.schema_name,
            messages=one.messages,
            start=(one.first_ns - log.base_ns) / 1e9,
            end=(one.last_ns - log.base_ns) / 1e9,
        )
        for key, one in log.merged_channels()
        if one.messages
    ]


def seconds(text: str) -> float:
    """A time in s since the first message.

    Raises:
        TouchlineError: it is no number, or no file has this time.
    """
    if (time := seconds_in(text)) is None:
        raise TouchlineError(f'"{text}" is no time in a log; give seconds since its first message')
    return time


def span_of(settings: ReplaySettings, end_ns: int) -> PlaybackRange:
    """The part of a log that lasts until `end_ns` which the settings name.

    Raises:
        TouchlineError: a time is no number, or the part is empty.
    """
    start_ns = round(seconds(settings.start or "0") * 1e9)
    stop_ns = round(seconds(settings.end) * 1e9) if settings.end is not None else None
    if start_ns > end_ns:
        raise TouchlineError(
            f"--from {settings.start} is after the last message at {end_ns / 1e9:.2f} s; begin earlier"
        )
    if stop_ns is not None and stop_ns < start_ns:
        raise TouchlineError(f"--to {settings.end} is before --from {settings.start or 0}; end later")
    return PlaybackRange(start_ns, stop_ns)
