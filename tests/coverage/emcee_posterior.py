#!/usr/bin/env python3
"""The posterior of docs/theory/identification.md by another hand, sampled by emcee.

usage: emcee_posterior.py POSTERIOR_DUMP [--persons 2] [--first 1] [--steps 3000] [--walkers 64] [--draws 1000]

Every person that `posterior_dump` makes is sampled in the unknowns without bounds. The density is
written here from its equations; recordings, filters of the noise and the columns of the unseen
quantities at the reference are read. --steps 0: only the densities are compared. --draws: of the
program, by Hamiltonian Monte Carlo; 0: of its approximation.
Exit code 1: they disagree; 77: numpy, scipy or emcee is not installed.
"""
import argparse
import json
import subprocess
import sys

try:
    import numpy as np
    from scipy.interpolate import CubicSpline
    from scipy.special import erfinv, expit, logsumexp, ndtr
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-numpy, python3-scipy)")
    sys.exit(77)
try:
    import emcee
except ImportError:
    emcee = None

BAND_HZ = 1.5
SD, TIME, KAPPA, MODEL, SHARE = 0, 1, 2, 3, 8  # places of the hyperparameters; s and four sizes from MODEL on


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


def pairs(rows):
    """Of each column k of `rows` the products rows_ik rows_jk, as one row."""
    return np.einsum("ik,jk->kij", rows, rows).reshape(rows.shape[1], -1)


def cholesky(a):
    """Factors, and of which persons the matrix is not positive definite; the identity stands for these."""
    try:
        return np.linalg.cholesky(a), np.zeros(len(a), bool)
    except np.linalg.LinAlgError:
        one = np.eye(a.shape[1])
        finite = np.isfinite(a).all(axis=(1, 2))
        a = np.where(finite[:, None, None], a, one)
        worse = ~(np.linalg.eigvalsh(a)[:, 0] > 1e-12 * np.trace(a, axis1=1, axis2=2)) | ~finite
        return np.linalg.cholesky(np.where(worse[:, None, None], one, a)), worse


class Run:
    """One run, and all of it that no unknown changes."""

    def __init__(self, given):
        for key in ("time", "length", "velocity", "arm", "measured", "sd", "unseen", "by_slope"):
            setattr(self, key, np.array(given[key]))
        self.trial = given["trial"]
        low = self.low = low_pass({**given, "time": self.time})
        self.seen, self.turning = low @ self.unseen, low @ self.by_slope
        n, m = len(self.time), len(self.measured)
        self.drive = [CubicSpline(e["time"], e["value"]) for e in given["envelopes"]]
        self.ends = [(e["time"][0], e["time"][-1]) for e in given["envelopes"]]
        self.share = np.array([e["share"] for e in given["envelopes"]])
        self.lags = self.time - self.time[0]
        self.at_lag = np.array([(low[:, max(0, -d):n - max(0, d)] @ low[:, max(0, d):n - max(0, -d)].T).ravel()
                                for d in range(-n + 1, n)])
        self.at_lag = self.at_lag[n - 1:] + np.vstack([np.zeros(m * m), self.at_lag[n - 2::-1]])
        self.noise = []
        for e in given["envelopes"]:
            h = np.array(e["filter"])
            reach = len(h) // 2
            dense = np.zeros((n, n + 2 * reach))
            for i in range(n):
                dense[i, i:i + len(h)] = h
            self.noise.append((pairs(low @ dense), np.clip(np.arange(n + 2 * reach) - reach, 0, n - 1)))


class Posterior:
    def __init__(self, dump):
        self.unknowns, self.muscles = dump["unknowns"], dump["muscles"]
        get = lambda key: np.array([u[key] for u in self.unknowns])
        self.lower, self.range = get("lower"), get("upper") - get("lower")
        self.mean, sd, self.judged = get("mean"), get("sd"), get("judgment")
        self.log_lambda = 0.3 * np.linspace(-4.0, 5.0, 451)
        end = [(bound - self.mean)[self.judged] / sd[self.judged] for bound in (self.lower, get("upper"))]
        low, high = (ndtr(e / np.exp(self.log_lambda)[:, None]) for e in end)
        self.log_prior = -0.5 * (self.log_lambda / 0.3) ** 2 - np.log(high - low).sum(axis=1)
        self.judged_sd = sd[self.judged]
        names, common_sd = get("name"), get("common_sd")
        self.sharp = (common_sd > 0.0) & (names == "emg_gain")
        common = (names[:, None] == names) * np.outer(common_sd, common_sd)
        self.precision = np.linalg.inv(common + np.diag(sd * sd))
        self.logarithmic = get("logarithmic")
        self.weight, self.size = np.array(dump["weight"]), np.array(dump["size"]).astype(int)
        self.growth, self.reference = np.array(dump["growth"]), np.array(dump["reference"])
        self.torque_size = dump["torque_size"]
        slopes = np.array(dump["slopes"]).reshape(-1, 3)
        self.turned = np.eye(len(self.weight))[slopes[:, 0].astype(int)]  # of which column a slope is
        self.turns_with, self.reach = slopes[:, 1].astype(int), slopes[:, 2]
        self.runs = [Run(given) for given in dump["runs"]]
        for run in self.runs:  # of a trial's rows, so many count
            rows = sum(len(other.measured) for other in self.runs if other.trial == run.trial)
            run.weight = min(1.0, dump["independent_rows"] / rows) if dump["independent_rows"] > 0.0 else 1.0

    def share(self, x):
        """The share of the way between the bounds, and ln of its slope by x, for each unknown."""
        x = x[:, :len(self.lower)]
        from_lower = 10.0 + 5.0 * x  # in units of a twentieth of the way
        from_upper = from_lower - 20.0
        share = np.where(self.sharp, (np.logaddexp(0.0, from_lower) - np.logaddexp(0.0, from_upper)) / 20.0, expit(x))
        # Of sharp ends the slope is the difference of two logistic functions, over 4.
        fall = np.logaddexp(0.0, -from_lower) + np.logaddexp(0.0, from_upper) + np.log(4.0) - np.log1p(-np.exp(-20.0))
        return share, -np.where(self.sharp, fall, np.logaddexp(0.0, x) + np.logaddexp(0.0, -x))

    def z(self, x):
        return self.lower + self.range * self.share(x)[0]

    def noise(self, x):
        """ln sigma_T, ln tau, ln kappa, ln s by its normal score, ln of four sizes, ln b of each trial."""
        noise = x[:, len(self.lower):].copy()
        noise[:, MODEL] = np.log(0.1 * np.sqrt(2.0) * erfinv(ndtr(noise[:, MODEL])))
        return noise

    def torques(self, run, z):
        """The torque of each muscle, muscles x persons x n."""
        v = {}
        for j, u in enumerate(self.unknowns):
            v[u["name"], u["owner"]] = (np.exp(z[:, j]) if self.logarithmic[j] else z[:, j])[:, None]
        self.offset = v.get(("joint_torque_offset", 0), 0.0)
        all_of = []
        for k, held in enumerate(self.muscles):
            f, l0 = v["max_isometric_force", k], v["optimal_fiber_length", k]
            w, vsh = v["force_length_width", k], v["concentric_curvature", k]
            vml, s = v["eccentric_plateau", k], v["eccentric_slope_ratio", k]
            vmax = held["max_shortening_speed"]
            slack = v.get(("tendon_slack_length", k), held["tendon_slack_length"])
            product = (vml - 1.0) * vsh / (s * (1.0 + vsh))
            time = np.clip(run.time - v["emg_delay", 0], *run.ends[k])
            a = v["emg_gain", k] * np.maximum(run.drive[k](time), 0.0)
            x = (run.length[:, k] - slack - l0) / w
            speed = run.velocity[:, k]
            short, long = np.clip(speed, -vmax, 0.0), np.maximum(speed, 0.0)
            fv = np.where(speed > 0.0, (product * vmax + vml * long) / (product * vmax + long),
                          vsh * (vmax + short) / (vsh * vmax - short))
            all_of.append(run.arm[:, k] * f * a * np.exp(-x * x) * fv)
        return np.array(all_of)

    def __call__(self, x):
        """ln p of each row of x."""
        x = np.atleast_2d(x)
        far = np.abs(x).max(axis=1) > 30.0
        x = np.where(far[:, None], 0.0, x)
        p = len(self.lower)
        z, noise = self.z(x), self.noise(x)
        off = z - self.mean
        judged = ((off[:, self.judged] / self.judged_sd) ** 2).sum(axis=1)[:, None]
        off = np.where(self.judged, 0.0, off)
        result = -0.5 * np.einsum("wi,ij,wj->w", off, self.precision, off) + self.share(x)[1].sum(axis=1)
        # The spreads that are judgments share a factor lambda, over which the prior is integrated.
        over = self.log_prior - len(self.judged_sd) * self.log_lambda - 0.5 * judged * np.exp(-2.0 * self.log_lambda)
        result += logsumexp(over, axis=1) + np.log(self.log_lambda[1] - self.log_lambda[0])
        result -= 0.5 * ((noise[:, SD] - np.log(0.05 * self.torque_size)) / 1.5) ** 2
        result -= 0.5 * ((noise[:, TIME] - np.log(0.3)) / 0.5) ** 2 + 0.5 * (noise[:, KAPPA] / 0.3) ** 2
        result -= 0.5 * x[:, p + MODEL] ** 2 + 0.5 * (noise[:, SHARE:] ** 2).sum(axis=1)
        sizes = noise[:, MODEL + 1:SHARE]
        result += (sizes - 0.5 * np.exp(2.0 * sizes)).sum(axis=1)
        width = self.weight * np.where(self.size >= 0, np.exp(noise[:, np.maximum(self.size, 0)]), 1.0)
        gram = np.zeros((len(x), len(self.weight), len(self.weight)))
        seen = np.zeros((len(x), len(self.weight)))
        turn = self.reach * np.tanh((z - self.reference)[:, self.turns_with] / self.reach)
        for run in self.runs:
            torque = self.torques(run, z)
            m = len(run.measured)
            variance = np.exp(2.0 * (noise[:, SD] + noise[:, SHARE + run.trial]))
            a = (variance[:, None] * np.exp(-run.lags / np.exp(noise[:, TIME])[:, None])) @ run.at_lag
            for c, (kernel, at) in enumerate(run.noise):
                scale = np.exp(2.0 * noise[:, KAPPA]) * run.sd[c] ** 2 * run.share[c]
                a += (scale[:, None] * torque[c][:, at] ** 2) @ kernel
            root, worse = cholesky(a.reshape(-1, m, m) + (0.002 * self.torque_size) ** 2 * np.eye(m))
            far |= worse
            r = run.measured - (torque.sum(axis=0) + self.offset) @ run.low.T
            columns = run.seen + (turn[:, None, :] * run.turning) @ self.turned
            right = np.concatenate([r[:, :, None], columns * width[:, None, :]], axis=2)
            both = np.linalg.solve(root, right) * np.sqrt(run.weight)
            result -= 0.5 * (both[:, :, 0] ** 2).sum(axis=1)
            result -= run.weight * np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1)
            gram += np.einsum("wmi,wmj->wij", both[:, :, 1:], both[:, :, 1:], optimize=True)
            seen += np.einsum("wmi,wm->wi", both[:, :, 1:], both[:, :, 0])
        grown = np.exp((z - self.reference) @ self.growth.T)
        root, worse = cholesky(np.eye(len(self.weight)) + gram)
        far |= worse
        result -= np.log(np.diagonal(root, axis1=1, axis2=2)).sum(axis=1)
        root, worse = cholesky(np.eye(len(self.weight)) + grown[:, :, None] * gram * grown[:, None, :])
        far |= worse
        half = np.linalg.solve(root, (grown * seen)[:, :, None])[:, :, 0]
        result += 0.5 * (half ** 2).sum(axis=1)
        return np.where(far | ~np.isfinite(result), -np.inf, result)


def compare(number, options):
    dump = json.loads(subprocess.run([options.dump, str(number), str(options.draws if options.steps else 0)],
                                     check=True, capture_output=True).stdout)
    posterior = Posterior(dump)
    best, covariance = np.array(dump["best_x"]), np.array(dump["covariance"])
    off = posterior(best)[0] - dump["density_at_best"]
    print(f"person {number}: {dump['modes']} modes, R-hat {dump['rhat']:.2f}; the densities at the mode differ "
          f"by {off:.5f}", flush=True)
    if options.steps == 0:
        return abs(off) < 0.02
    rng = np.random.default_rng(number)
    np.random.seed(number)
    start = rng.multivariate_normal(best, 0.5 * covariance, size=options.walkers)
    sampler = emcee.EnsembleSampler(
        options.walkers, len(best), posterior, vectorize=True,
        moves=[(emcee.moves.DEMove(), 0.7), (emcee.moves.DESnookerMove(), 0.1), (emcee.moves.StretchMove(), 0.2)])
    sampler.run_mcmc(start, options.steps)
    time = np.median(sampler.get_autocorr_time(tol=0))
    x = sampler.get_chain(discard=options.steps // 3, flat=True)
    values = np.hstack([posterior.z(x), posterior.noise(x)])
    mean, sd = values.mean(axis=0), values.std(axis=0)
    shift = (np.array(dump["mean"]) - mean) / sd
    ratio = np.array(dump["sd"]) / sd
    names = [u["label"] for u in posterior.unknowns] + ["ln sigma_T", "ln tau_T", "ln kappa", "ln s"]
    names += [f"ln b {i + 1}" for i in range(len(mean) - len(names))]
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
    arguments.add_argument("--steps", type=int, default=3000)
    arguments.add_argument("--walkers", type=int, default=64)
    arguments.add_argument("--draws", type=int, default=1000)
    options = arguments.parse_args()
    if options.steps and emcee is None:
        print("skipped: no emcee (Debian: python3-emcee)")
        sys.exit(77)
    right = [compare(n, options) for n in range(options.first, options.first + options.persons)]
    sys.exit(0 if all(right) else 1)


main()
