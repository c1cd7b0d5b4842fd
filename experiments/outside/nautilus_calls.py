"""nautilus (neural importance nested sampling) on targets of the catalogue: density calls, seconds, error of log Z, a CSV row per run.

    pip install nautilus-sampler==1.0.6
    cargo build --release -p parvi-targets --example log_densities
    python3 nautilus_calls.py target/release/examples/log_densities NAME[:DIM:TARGET_SEED] ... > nautilus.csv

The prior is logistic on every axis: about 0 with scale 1 for the posteriors of sbibm, whose own that is; about the centre of a random target's rough frame
with three of its scales. Calls and seconds are all of a run with 1,000 live points and nautilus' other defaults.
"""

import struct
import subprocess
import sys
import time

import numpy as np
from nautilus import Sampler

LIVE_POINTS = 1000
SEEDS = range(1)


class Target:
    """A target behind pipes."""

    def __init__(self, program, specification):
        name, *rest = specification.split(":")
        pipe = subprocess.PIPE
        self.process = subprocess.Popen([program, name, *rest], stdin=pipe, stdout=pipe)
        self.log_evidence, *numbers = map(float, self.process.stdout.readline().split())
        centre, scales = np.array(numbers).reshape(2, -1)
        self.dimension = len(centre)
        own = name.startswith("sbibm-")
        self.centre, self.scales = (0.0 * centre, 1.0 + 0.0 * scales) if own else (centre, 3.0 * scales)
        self.seconds = 0.0

    def log_densities(self, points):
        begin = time.perf_counter()
        points = np.ascontiguousarray(np.atleast_2d(points), dtype="<f8")
        self.process.stdin.write(struct.pack("<Q", len(points)) + points.tobytes())
        self.process.stdin.flush()
        values = np.frombuffer(self.process.stdout.read(8 * len(points)), dtype="<f8")
        self.seconds += time.perf_counter() - begin
        return values

    def prior(self, cube):
        cube = np.clip(cube, 1e-300, 1 - 1e-16)
        return self.centre + self.scales * (np.log(cube) - np.log1p(-cube))

    def log_likelihood(self, points):
        """Density over prior."""
        size = np.abs((points - self.centre) / self.scales)
        log_prior = -size - 2 * np.log1p(np.exp(-size)) - np.log(self.scales)
        return self.log_densities(points) - np.atleast_2d(log_prior).sum(axis=1)

    def run(self, seed):
        self.seconds = 0.0
        sampler = Sampler(
            self.prior, self.log_likelihood, n_dim=self.dimension, n_live=LIVE_POINTS,
            pass_dict=False, vectorized=True, seed=seed,
        )
        wall, processor = time.perf_counter(), time.process_time()
        sampler.run(verbose=False)
        wall, processor = time.perf_counter() - wall, time.process_time() - processor
        return sampler.n_like, wall, processor, self.seconds, sampler.log_z


def main(program, *specifications):
    print("target,seed,density_evaluations,wall_seconds,processor_seconds,density_seconds,log_evidence_deviation", flush=True)
    for specification in specifications:
        target = Target(program, specification)
        for seed in SEEDS:
            calls, wall, processor, density, found = target.run(seed)
            deviation = found - target.log_evidence
            print(f"{specification},{seed},{calls},{wall:.2f},{processor:.2f},{density:.2f},{deviation:.4f}", flush=True)
        target.process.stdin.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
