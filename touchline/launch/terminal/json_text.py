"""Results as JSON, for programs."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from schemas.wire.part import Part


def json_text(content: Any, indent: int | None = None) -> str:
    """Parts, dataclasses, paths, mappings and lists of them as JSON, in one line, or indented by so many spaces."""
    return json.dumps(content, ensure_ascii=False, indent=indent, default=_plain)


def _plain(value: Any) -> Any:
    if isinstance(value, Part):
        return value.plain()
    return str(value) if isinstance(value, Path) else asdict(value)
