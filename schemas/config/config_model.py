"""The base of the configuration: a model of a table in a file of the user, or of an object in a file of settings."""

from typing import Any

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler
from pydantic_core import CoreSchema

from schemas.wire.field_docstrings import field_docstrings


class ConfigModel(BaseModel):
    """A table: immutable, without unknown fields, NaN or infinity; its JSON Schema has the docstrings of its fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        schema = handler(core_schema)
        descriptions = field_docstrings(cls)
        for name, field in handler.resolve_ref_schema(schema).get("properties", {}).items():
            if name in descriptions:
                field["description"] = descriptions[name]
        return schema
