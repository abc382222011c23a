"""The Dask cluster that the server would have long work done on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reina.api.settings import require_scheduler
from reina.cli.doctor.finding import fail, ok, warn
from reina.errors import InputError
from reina.system.cluster import ClusterError, cluster_at, threads_of

if TYPE_CHECKING:
    from reina.api.settings import Settings
    from reina.cli.doctor.finding import Finding


def scheduler_finding(settings: Settings) -> Finding:
    """Whether the scheduler answers, and has workers."""
    try:
        require_scheduler(settings)
    except InputError as error:
        return fail("scheduler", str(error), "set REINA_SCHEDULER to a scheduler's address, or leave it out")
    start = "start `dask scheduler` and `dask worker` there; until then this machine does the work"
    try:
        with cluster_at(settings.scheduler) as client:
            threads = threads_of(client)
    except ClusterError as error:
        return warn("scheduler", str(error), start)
    if not threads:
        return warn("scheduler", f"{settings.scheduler} answers and has no workers", start)
    return ok("scheduler", f"{settings.scheduler} answers; {threads} pieces of work at a time")
