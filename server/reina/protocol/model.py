"""The base of every model on the wire."""

from pydantic import ConfigDict

from reina.system.described import DescribedModel


class WireModel(DescribedModel):
    """Immutable, and strict about fields that the contract does not name.

    A default is for whoever builds the model in Python; what the server sends always holds every field,
    so the generated TypeScript marks none of them optional (see `reina.protocol.typescript`).
    """

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        allow_inf_nan=False,
        json_schema_serialization_defaults_required=True,
    )


class RequestModel(WireModel):
    """What is sent to the server; strict about types too: true is no number, "3" neither."""

    model_config = ConfigDict(strict=True)
