"""`touchline topics`: the topic table."""

import json as json_text
from typing import Any

import typer

from schemas.topic import Topic
from schemas.topics import TOPICS
from touchline.cli import options

_COLUMNS = ("name", "key", "message", "from", "to", "rate", "delivery", "recorded", "description")


def topics(json: options.Json = False) -> None:
    """List every topic: key, message, writer, readers, rate, delivery, recorded or not.

    Example: touchline topics --json | jq '.[] | select(.recorded).key'
    """
    rows = [_row(name, topic) for name, topic in TOPICS.items()]
    if json:
        typer.echo(json_text.dumps(rows, ensure_ascii=False, indent=2))
        return
    cells = [_COLUMNS, *(tuple(_cell(row[column]) for column in _COLUMNS) for row in rows)]
    widths = [max(len(line[place]) for line in cells) for place in range(len(_COLUMNS))]
    typer.echo("All keys are below touchline/{match}/.\n")
    for line in cells:
        typer.echo("  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip())


def _row(name: str, topic: Topic) -> dict[str, Any]:
    return {
        "name": name,
        "key": topic.key,
        "message": topic.message.__name__ if topic.message is not None else None,
        "reply": topic.reply.__name__ if topic.reply is not None else None,
        "from": [writer.value for writer in topic.writers],
        "to": [reader.value for reader in topic.readers],
        "rate": topic.rate,
        "delivery": topic.delivery.value,
        "recorded": topic.recorded,
        "description": topic.description,
    }


def _cell(value: Any) -> str:
    match value:
        case None:
            return "-"
        case bool():
            return "yes" if value else "no"
        case list():
            return ", ".join(value)
        case _:
            return str(value)
