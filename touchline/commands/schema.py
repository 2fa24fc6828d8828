"""`touchline schema`: the JSON Schema of a message, for teams in any language."""

import json
from typing import Annotated

import typer

from schemas.errors import TouchlineError, did_you_mean
from schemas.topics import TOPICS
from schemas.wire.message import Part, WireMessage


def schema(
    name: Annotated[str, typer.Argument(help="A topic as `touchline topics` names it, or a message's class name.")],
) -> None:
    """Print the JSON Schema of a message.

    Example: touchline schema command
    """
    models = known()
    if name not in models:
        raise TouchlineError(f'schema of "{name}": no such topic or message; {did_you_mean(name, models)}')
    typer.echo(json.dumps(models[name].json_schema(), ensure_ascii=False, indent=2))


def known() -> dict[str, type[WireMessage | Part]]:
    """Topic or class name → message, including replies to queries and the match file."""
    from schemas.config.match_config import MatchConfig

    models: dict[str, type[WireMessage | Part]] = {"MatchConfig": MatchConfig}
    for topic, row in TOPICS.items():
        if row.message is not None:
            models |= {topic: row.message, row.message.__name__: row.message}
        if row.reply is not None:
            models[row.reply.__name__] = row.reply
    return models
