"""The laboratory: everything that the page at /lab shows is computed by these calls."""

from fastapi import APIRouter

from reina.api.lab import chains, clips, rotations

router = APIRouter(prefix="/lab", tags=["lab"])
for table in (rotations, chains, clips):
    router.include_router(table.router)
