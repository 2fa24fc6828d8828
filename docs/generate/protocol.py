"""The page on the protocol: how to join, the topic table, and every message with its fields and an example.

`python docs/generate/protocol.py > docs/protocol.md` writes it.
"""

import json
import re
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from enum import Enum
from inspect import cleandoc
from pathlib import Path
from typing import Any

from pydantic_core import from_json

from message_examples import examples
from protocol_fields import is_part, parts_of, rows
from runtime.access.accounts import ACCOUNTS, Account
from runtime.access.rights import Rights
from schemas.side import Side
from schemas.topic import Topic
from schemas.topics import TOPICS
from schemas.wire.message import VERSION, Message

_NOTE = "<!-- Made by `python docs/generate/protocol.py > docs/protocol.md`; to change this page, change schemas/. -->"
_WIDE = 110
"""Most characters in a line of an example, where the line can be broken."""
_TOPIC_HEADINGS = ("key", "message", "from", "to", "rate", "delivery", "recorded", "description")
_ACCOUNT_HEADINGS = ("account", "who", "publishes", "subscribes", "queries", "answers queries", "tokens")
_FIELD_HEADINGS = ("field", "type", "default", "meaning")


def page() -> str:
    """The whole page, Markdown."""
    messages = _messages(TOPICS.values())
    parts = _parts(messages)
    titles = _titles([*messages, *parts])
    overview, joining = (_text(name) for name in ("protocol_overview.md", "protocol_joining.md"))
    sections = [
        f"# The protocol, version {VERSION}",
        _NOTE,
        overview,
        joining,
        "## Topics",
        "All keys are below `touchline/{match}/`; words in braces are placeholders. On a topic whose delivery is "
        "`query`, the message before the arrow is the request and the one behind it the reply.",
        _table(_TOPIC_HEADINGS, [_topic_cells(topic, titles) for topic in TOPICS.values()]),
        "## Who may do what",
        "The accounts of a host with credentials. `{robot}` stands for each robot of the account's side; a key in "
        "*subscribes* with a † can be recovered: missed and earlier messages are fetched from the publisher's cache.",
        _table(_ACCOUNT_HEADINGS, [_account_cells(account) for account in ACCOUNTS]),
        "## Messages",
        f"Every message has a field `version` (text, default `{VERSION}`) beside those listed. A field without a "
        "default is required; fields that are not listed, NaN and infinity are refused. A payload of more than "
        f"{Message.max_bytes} bytes is refused without being parsed.",
        *(_message(kind, titles) for kind in messages),
        "## Parts",
        *(_part(kind, titles) for kind in parts),
    ]
    return "\n\n".join(sections) + "\n"


def _text(name: str) -> str:
    return (Path(__file__).parent / name).read_text("utf-8").strip()


def _messages(topics: Iterable[Topic]) -> list[type[Message]]:
    """Every message and every reply once, in the order of the table."""
    both = [kind for topic in topics for kind in (topic.message, topic.reply) if kind is not None]
    return list(dict.fromkeys(both))


def _parts(messages: Sequence[type]) -> list[type]:
    """The parts and enumerations in messages, each once, in the order of their first mention."""
    met: dict[type, None] = dict.fromkeys(messages)
    waiting = list(messages)
    while waiting:
        kind = waiting.pop(0)
        new = [part for part in parts_of(kind) if part not in met] if is_part(kind) else []
        met.update(dict.fromkeys(new))
        waiting = [*new, *waiting]
    return [kind for kind in met if kind not in messages]


def _titles(kinds: Sequence[type]) -> dict[type, str]:
    """The heading of each type on the page; types of the same name are distinguished by their module."""
    names = Counter(kind.__name__ for kind in kinds)
    return {
        kind: kind.__name__ if names[kind.__name__] == 1 else f"{kind.__name__} ({kind.__module__.split('.')[-1]})"
        for kind in kinds
    }


def _link(title: str) -> str:
    """A link to a heading of the page, with the anchor that Markdown renderers give it."""
    anchor = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
    return f"[{title}](#{anchor})"


def _topic_cells(topic: Topic, titles: dict[type, str]) -> tuple[str, ...]:
    message = _link(titles[topic.message]) if topic.message is not None else "–"
    reply = f" → {_link(titles[topic.reply])}" if topic.reply is not None else ""
    return (
        f"`{topic.key}`",
        message + reply,
        ", ".join(writer.value for writer in topic.writers),
        ", ".join(reader.value for reader in topic.readers),
        topic.rate,
        topic.delivery.value,
        "yes" if topic.recorded else "no",
        topic.description,
    )


def _account_cells(account: Account) -> tuple[str, ...]:
    rights = Rights(account, {side: ["{robot}"] for side in Side})
    subscribed = [f"`{key}`{' †' if key in rights.recovers else ''}" for key in rights.subscribes]
    others = (rights.queries, rights.serves, rights.declares)
    publishes, *rest = (", ".join(f"`{key}`" for key in keys) or "–" for keys in (rights.publishes, *others))
    return (f"`{account.value}`", ACCOUNTS[account].description, publishes, ", ".join(subscribed), *rest)


def _message(kind: type[Message], titles: dict[type, str]) -> str:
    keys = [f"`{topic.key}`" for topic in TOPICS.values() if kind in (topic.message, topic.reply)]
    size = f"; at most {kind.max_bytes} bytes" if kind.max_bytes != Message.max_bytes else ""
    where = f"On {', '.join(keys)}{size}."
    return "\n\n".join([_part(kind, titles), where, f"```json\n{laid_out(examples()[kind])}\n```"])


def _part(kind: type, titles: dict[type, str]) -> str:
    """Heading, docstring, and the table of fields or the values of an enumeration."""
    sections = [f"### {titles[kind]}", " ".join(cleandoc(kind.__doc__ or "").split())]
    if issubclass(kind, Enum):
        sections.append(", ".join(f"`{member.value}`" for member in kind))
    else:
        fields = rows(kind, lambda part: _link(titles[part]))
        cells = [(f"`{row.name}`", row.type, f"`{row.default}`" if row.default else "", row.meaning) for row in fields]
        sections.append(_table(_FIELD_HEADINGS, cells) if cells else "No other fields.")
    return "\n\n".join(sections)


def _table(headings: Sequence[str], cells: Iterable[Sequence[str]]) -> str:
    lines = [headings, ["---"] * len(headings), *cells]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def laid_out(message: Message) -> str:
    """A message as JSON with one line for each field; the content of a long field is packed into several lines."""
    entries = [_entry(name, value, "  ") for name, value in from_json(message.encode()).items()]
    return "{\n" + ",\n".join(f"  {entry}" for entry in entries) + "\n}"


def _entry(name: str, value: Any, indent: str) -> str:
    text = f"{json.dumps(name)}: {json.dumps(value, ensure_ascii=False)}"
    if not isinstance(value, dict) or len(indent) + len(text) <= _WIDE:
        return text
    inside = indent + "  "
    entries = [_entry(below, content, inside) for below, content in value.items()]
    return f"{json.dumps(name)}: {{\n{_packed(entries, inside)}\n{indent}}}"


def _packed(entries: Sequence[str], indent: str) -> str:
    """Entries side by side as far as they fit; an entry of several lines shares them with no other."""
    lines: list[str] = []
    for entry in entries:
        last = lines[-1] if lines else None
        fits = last is not None and "\n" not in last + entry and len(last) + len(entry) + 3 <= _WIDE
        if last is not None and fits:
            lines[-1] = f"{last}, {entry}"
        else:
            lines.append(f"{indent}{entry}")
    return ",\n".join(lines)


if __name__ == "__main__":
    sys.stdout.write(page())
