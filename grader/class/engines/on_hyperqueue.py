#!/usr/bin/env python3
"""Grades a class with HyperQueue: one task for each submission. See README.md.

    cargo grader class ~/submissions --out ~/graded --part 1 --list > units.txt
    python3 on_hyperqueue.py units.txt [SERVER_DIR]

Without SERVER_DIR, the folder of a running HyperQueue server, it starts a server and a worker on
this machine and stops them at the end. It needs the package `hyperqueue` of PyPI.
"""

import multiprocessing
import pathlib
import sys

from hyperqueue import Client, Job, LocalCluster
from hyperqueue.cluster import WorkerConfig


def run(client, lines):
    """Runs each line in a shell, and returns the number of those that failed."""
    job = Job(max_fails=len(lines))
    for line in lines:
        # Why a task failed is in OUT/failures.
        job.program(["sh", "-c", line], stdout=None, stderr=None)
    submitted = client.submit(job)
    client.wait_for_jobs([submitted], raise_on_error=False)
    return len(client.get_failed_tasks(submitted))


def main():
    lines = pathlib.Path(sys.argv[1]).read_text().splitlines()
    if not lines:
        return 0
    if len(sys.argv) > 2:
        failed = run(Client(sys.argv[2]), lines)
    else:
        with LocalCluster() as cluster:
            cluster.start_worker(WorkerConfig(cores=multiprocessing.cpu_count()))
            failed = run(cluster.client(), lines)
    print(f"{len(lines) - failed} of {len(lines)} tasks are done, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
