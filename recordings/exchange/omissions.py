"""What an export leaves out: the messages of a recording for which a format has no place."""

from collections import Counter

from recordings.reading.recording import Recording
from schemas.topic import Topic
from schemas.topics import TOPICS


def omitted_messages(recording: Recording, *exported: Topic) -> dict[str, int]:
    """Key expression of a topic, `robot/*/sight` → messages, of all topics but the `exported` ones, sorted."""
    omitted: Counter[str] = Counter()
    for channel in recording.channels:
        topic = TOPICS.get(channel.topic)
        if topic not in exported and channel.messages:
            omitted[topic.fill() if topic is not None else channel.key] += channel.messages
    return dict(sorted(omitted.items()))
