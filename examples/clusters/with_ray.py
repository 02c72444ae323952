"""Runs a comparison on a Ray cluster: every actor keeps one `touchline worker`.

    python3 with_ray.py DIR/comparison.toml --out OUT [--address auto]

Without an address a local cluster is started. An actor claims one processor, so
that runs do not share it.
"""

from pathlib import Path

import campaign
import ray
import touchline_worker
from ray.util import ActorPool


@ray.remote(num_cpus=1)
class Planning:
    """An actor with its `touchline worker`."""

    def __init__(self, program: str) -> None:
        self.worker = touchline_worker.Worker(program)

    def run(self, job: campaign.Job) -> campaign.Result:
        """One run."""
        return campaign.result(job, self.worker.ask(job.request, job.timeout))


def main() -> None:
    """The command."""
    args = campaign.arguments("Runs a comparison on a Ray cluster.")
    # The modules travel to the machines with the job.
    here = {"working_dir": str(Path(__file__).resolve().parent)}
    local = {} if args.address else {"num_cpus": args.workers, "include_dashboard": False}
    ray.init(address=args.address, runtime_env=here, **local)
    count = args.workers if not args.address else int(ray.cluster_resources()["CPU"])
    pool = ActorPool([Planning.remote(args.program) for _ in range(count)])
    results = pool.map_unordered(lambda actor, job: actor.run.remote(job), campaign.jobs(args.comparison))
    campaign.write(results, args.out)
    ray.shutdown()


if __name__ == "__main__":
    main()
