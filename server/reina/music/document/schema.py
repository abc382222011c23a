"""The published JSON Schema of Reina's own score document (``score.schema.json``)."""

import json
from typing import Any

from reina.music.document.model import ScoreDocument


def score_schema() -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of a score document."""
    schema = ScoreDocument.model_json_schema(mode="validation")
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema, "title": "Reina score"}


def schema_text() -> str:
    """Return the schema as the file holds it."""
    return json.dumps(score_schema(), indent=2, ensure_ascii=False) + "\n"
