"""`touchline topics`: the topic table, and the JSON Schema of a message for teams in any language."""

from typing import Annotated, Any

import typer

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError, did_you_mean
from schemas.topic import Topic
from schemas.topics import TOPICS
from schemas.wire.message import Message
from touchline.commands.cli import options
from touchline.launch.terminal.aligned import aligned
from touchline.launch.terminal.json_text import json_text

_COLUMNS = ("name", "key", "message", "from", "to", "rate", "delivery", "recorded", "description")


def topics(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="A topic, or a message's class name: print its JSON Schema.")
    ] = None,
    json: options.Json = False,
) -> None:
    """List every topic: key, message, writer, readers, rate, delivery, recorded or not; or print a JSON Schema.

    Example: touchline topics --json | jq '.[] | select(.recorded).key'

    Example: touchline topics command
    """
    if name is not None:
        typer.echo(json_text(_schema(name), indent=2))
        return
    rows = [_row(name, topic) for name, topic in TOPICS.items()]
    if json:
        typer.echo(json_text(rows, indent=2))
        return
    cells = [_COLUMNS, *(tuple(_cell(row[column]) for column in _COLUMNS) for row in rows)]
    typer.echo("All keys are below touchline/{match}/.\n")
    for line in aligned(cells):
        typer.echo(line)


def _schema(name: str) -> dict[str, Any]:
    """The schema of a topic's message or of a class by name, replies to queries and the match file among them."""
    models: dict[str, type[Message]] = {}
    for topic, row in TOPICS.items():
        if row.message is not None:
            models |= {topic: row.message, row.message.__name__: row.message}
        if row.reply is not None:
            models[row.reply.__name__] = row.reply
    schemas = {"MatchConfig": MatchConfig.model_json_schema, **{one: kind.json_schema for one, kind in models.items()}}
    if name not in schemas:
        raise TouchlineError(f'schema of "{name}": no such topic or message; {did_you_mean(name, schemas)}')
    return schemas[name]()


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
