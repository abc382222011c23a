"""Asking an application without a network."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

import httpx

if TYPE_CHECKING:
    from fastapi import FastAPI


def ask(app: FastAPI, method: str, path: str, **options: Any) -> httpx.Response:
    """One answer of an application that has not begun its lifespan: it has settings, and no sessions."""

    async def asked() -> httpx.Response:
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return await client.request(method, path, **options)

    return asyncio.run(asked())
