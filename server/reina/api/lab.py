"""The laboratory: everything that the page at /lab shows is computed by these calls."""

from fastapi import APIRouter

from reina.api import lab_chains, lab_clips, lab_rotations

router = APIRouter(prefix="/lab", tags=["lab"])
for table in (lab_rotations, lab_chains, lab_clips):
    router.include_router(table.router)
