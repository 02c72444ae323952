"""Runs a comparison on a Dask cluster: every Dask worker keeps one `touchline worker`.

    python3 with_dask.py DIR/comparison.toml --out OUT [--address tcp://scheduler:8786]

Without an address a local cluster is started. Give Dask workers one thread each:
runs that share a core disturb each other's times.
"""

import campaign
import touchline_worker
from dask.distributed import Client, LocalCluster, Worker, WorkerPlugin, get_worker


class Planning(WorkerPlugin):
    """Gives a Dask worker its `touchline worker`."""

    def __init__(self, program: str) -> None:
        self.program = program

    def setup(self, worker: Worker) -> None:
        """Once, when the Dask worker joins."""
        worker.touchline = touchline_worker.Worker(self.program)

    def teardown(self, worker: Worker) -> None:
        """When it leaves."""
        worker.touchline.close()


def run(job: campaign.Job) -> campaign.Result:
    """One run, on whichever Dask worker."""
    return campaign.result(job, get_worker().touchline.ask(job.request, job.timeout))


def main() -> None:
    """The command."""
    args = campaign.arguments("Runs a comparison on a Dask cluster.")
    cluster = args.address or LocalCluster(n_workers=args.workers, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        for module in (touchline_worker, campaign):
            client.upload_file(module.__file__)
        client.register_plugin(Planning(args.program))
        # Not pure: two jobs that look the same are two runs.
        futures = client.map(run, campaign.jobs(args.comparison), pure=False)
        campaign.write(client.gather(futures), args.out)
    if not args.address:
        cluster.close()


if __name__ == "__main__":
    main()
