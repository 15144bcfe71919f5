#!/usr/bin/env python3
"""The posterior of docs/theory/posterior.md by another hand, sampled by emcee.

usage: emcee_posterior.py POSTERIOR_DUMP [--persons 2] [--first 1] [--steps 2500] [--walkers 136]

Every person that `posterior_dump` makes is sampled in the unknowns without bounds. The density is
written here from its equations; recordings, filters of the noise and the columns of the unseen
quantities at the reference are read. --steps 0: only the densities are compared.
Exit code 1: they disagree; 77: numpy or emcee is not installed.
"""
import argparse
import json
import subprocess
import sys

try:
    import numpy as np
    import emcee
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-numpy, python3-emcee)")
    sys.exit(77)

BAND_HZ = 1.5


def low_pass(run):
    """L: a Gaussian of -3 dB at 1.5 Hz, to three widths, in rows inside the run."""
    t = run["time"]
    n, m = len(t), len(run["measured"])
    width = np.sqrt(np.log(2.0)) / (2.0 * np.pi * BAND_HZ)
    rows = np.zeros((m, n))
    reach = int(np.ceil(3.0 * width * (n - 1) / (t[-1] - t[0])))
    for j in range(m):
        at = np.arange(2 * reach + 1) + run["first"] + j * run["stride"]
        x = (t[at] - t[at[reach]]) / width
        rows[j, at] = np.exp(-0.5 * x * x)
    return rows / rows.sum(axis=1, keepdims=True)


class Quintic:
    """The drive between its samples: natural enough by a cubic spline on its fine clock."""

    def __init__(self, t, y):
        from scipy.interpolate import CubicSpline
        self.t, self.spline = t, CubicSpline(t, y)

    def __call__(self, t):
        return np.maximum(self.spline(np.clip(t, self.t[0], self.t[-1])), 0.0)


class Posterior:
    def __init__(self, dump):
        self.unknowns, self.muscles = dump["unknowns"], dump["muscles"]
        get = lambda key: np.array([u[key] for u in self.unknowns])
        self.lower, self.range = get("lower"), get("upper") - get("lower")
        self.mean, sd = get("mean"), get("sd")
        strength = get("name") == "max_isometric_force"
        alike = np.outer(strength, strength) * dump["common_strength"]
        np.fill_diagonal(alike, 1.0)
        self.precision = np.linalg.inv(alike * np.outer(sd, sd))
        self.logarithmic = get("logarithmic")
        self.weight, self.of_model = np.array(dump["weight"]), np.array(dump["of_the_model"])
        self.torque_size = dump["torque_size"]
        self.runs = []
        for given in dump["runs"]:
            run = {k: np.array(v) if isinstance(v, list) and k != "envelopes" else v
                   for k, v in given.items()}
            run["L"] = low_pass(run)
            run["LS"] = run["L"] @ run["unseen"]
            run["drive"] = [Quintic(np.array(e["time"]), np.array(e["value"]))
                            for e in given["envelopes"]]
            run["K"] = []
            for e in given["envelopes"]:
                h = np.array(e["filter"])
                n, reach = len(run["time"]), len(h) // 2
                dense = np.zeros((n, n + 2 * reach))
                for i in range(n):
                    dense[i, i:i + len(h)] = h
                full = run["L"] @ dense
                run["K"].append((full, np.clip(np.arange(n + 2 * reach) - reach, 0, n - 1)))
            run["share"] = np.array([e["share"] for e in given["envelopes"]])
            run["apart"] = np.abs(run["time"][:, None] - run["time"][None, :])
            self.runs.append(run)

    def values(self, z):
        v = {}
        for u, x in zip(self.unknowns, z):
            v[u["name"], u["owner"]] = np.exp(x) if u["logarithmic"] else x
        return v

    def torques(self, run, v):
        """The torque of each muscle, n x muscles."""
        all_of = []
        for k, held in enumerate(self.muscles):
            f, l0 = v["max_isometric_force", k], v["optimal_fiber_length", k]
            w, vsh = v["force_length_width", k], v["concentric_curvature", k]
            vml, s = v["eccentric_plateau", k], v["eccentric_slope_ratio", k]
            vmax, slack = held["max_shortening_speed"], held["tendon_slack_length"]
            product = (vml - 1.0) * vsh / (s * (1.0 + vsh))
            a = v["emg_gain", k] * run["drive"][k](run["time"] - v["emg_delay", 0])
            z = (run["length"][:, k] - slack - l0) / w
            speed = run["velocity"][:, k]
            short, long = np.clip(speed, -vmax, 0.0), np.maximum(speed, 0.0)
            fv = np.where(speed > 0.0, (product * vmax + vml * long) / (product * vmax + long),
                          vsh * (vmax + short) / (vsh * vmax - short))
            all_of.append(run["arm"][:, k] * f * a * np.exp(-z * z) * fv)
        return np.array(all_of).T

    def __call__(self, x):
        p = len(self.unknowns)
        if np.abs(x).max() > 40.0:
            return -np.inf
        q = 1.0 / (1.0 + np.exp(-x[:p]))
        z = self.lower + self.range * q
        ln_sd, ln_time, ln_kappa, ln_s = x[p:]
        off = z - self.mean
        result = -0.5 * off @ self.precision @ off + np.sum(np.log(q * (1.0 - q)))
        result -= 0.5 * ((ln_sd - np.log(0.05 * self.torque_size)) / 1.5) ** 2
        result -= 0.5 * (ln_time - np.log(0.3)) ** 2 + 0.5 * (ln_kappa / 0.3) ** 2
        s = np.exp(ln_s)
        result += ln_s - 0.5 * (s / 0.1) ** 2
        v = self.values(z)
        width = self.weight * np.where(self.of_model > 0.5, s, 1.0)
        gram, seen = np.eye(len(width)), np.zeros(len(width))
        for run in self.runs:
            torque = self.torques(run, v)
            low = run["L"]
            a = low @ np.exp(2.0 * ln_sd - run["apart"] / np.exp(ln_time)) @ low.T
            for c, (kernel, at) in enumerate(run["K"]):
                root = kernel * torque[at, c]
                a += np.exp(2.0 * ln_kappa) * run["sd"][c] ** 2 * run["share"][c] * root @ root.T
            offset = v.get(("joint_torque_offset", 0), 0.0)
            r = run["measured"] - low @ (torque.sum(axis=1) + offset)
            try:
                root = np.linalg.cholesky(a)
            except np.linalg.LinAlgError:
                return -np.inf
            both = np.linalg.solve(root, np.column_stack([r, run["LS"] * width]))
            result -= 0.5 * both[:, 0] @ both[:, 0] + np.log(np.diag(root)).sum()
            gram += both[:, 1:].T @ both[:, 1:]
            seen += both[:, 1:].T @ both[:, 0]
        root = np.linalg.cholesky(gram)
        half = np.linalg.solve(root, seen)
        return result + 0.5 * half @ half - np.log(np.diag(root)).sum()


def compare(number, options):
    dump = json.loads(subprocess.run([options.dump, str(number)], check=True,
                                     capture_output=True).stdout)
    posterior = Posterior(dump)
    best, covariance = np.array(dump["best_x"]), np.array(dump["covariance"])
    off = posterior(best) - dump["density_at_best"]
    print(f"person {number}: {dump['modes']} modes, k-hat {dump['khat']:.2f}, approximate "
          f"{dump['approximate']}; the densities at the mode differ by {off:.5f}")
    if options.steps == 0:
        return abs(off) < 0.02
    rng = np.random.default_rng(number)
    np.random.seed(number)
    start = rng.multivariate_normal(best, 0.5 * covariance, size=options.walkers)
    sampler = emcee.EnsembleSampler(
        options.walkers, len(best), posterior,
        moves=[(emcee.moves.DEMove(), 0.7), (emcee.moves.DESnookerMove(), 0.1),
               (emcee.moves.StretchMove(), 0.2)])
    sampler.run_mcmc(start, options.steps)
    time = np.median(sampler.get_autocorr_time(tol=0))
    x = sampler.get_chain(discard=options.steps // 3, flat=True)
    p = len(posterior.unknowns)
    values = x.copy()
    values[:, :p] = posterior.lower + posterior.range / (1.0 + np.exp(-x[:, :p]))
    mean, sd = values.mean(axis=0), values.std(axis=0)
    shift = (np.array(dump["mean"]) - mean) / sd
    ratio = np.array(dump["sd"]) / sd
    names = [u["label"] for u in posterior.unknowns] + ["ln sigma_T", "ln tau_T", "ln kappa", "ln s"]
    for i, name in enumerate(names):
        print(f"  {name:32} mean {shift[i]:6.2f} sd   sd {ratio[i]:5.2f}")
    print(f"  autocorrelation time {time:.0f} steps, accepted {sampler.acceptance_fraction.mean():.2f}; "
          f"means within {np.abs(shift).max():.2f} sd, median {np.median(np.abs(shift)):.2f}; "
          f"sd {ratio.min():.2f} to {ratio.max():.2f}, median {np.median(ratio):.2f}; "
          f"{np.mean(np.abs(shift) < 0.15) * 100:.0f} % of means within 0.15 sd, "
          f"{np.mean(np.abs(ratio - 1.0) < 0.1) * 100:.0f} % of sd within 10 %", flush=True)
    return np.abs(shift).max() < 0.15 and np.abs(ratio - 1.0).max() < 0.1


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("dump")
    arguments.add_argument("--persons", type=int, default=2)
    arguments.add_argument("--first", type=int, default=1)
    arguments.add_argument("--steps", type=int, default=2500)
    arguments.add_argument("--walkers", type=int, default=136)
    options = arguments.parse_args()
    right = [compare(n, options) for n in range(options.first, options.first + options.persons)]
    sys.exit(0 if all(right) else 1)


main()
