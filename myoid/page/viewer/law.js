// The law of one muscle: the same equations, in the same order, as fit/measurement/muscle_law.cpp.
// `p`: the muscle's numbers in the order of MuscleField there.
export const FIELD = {
  maxForce: 0, fiberLength: 1, width: 2, curvature: 3, product: 4, plateau: 5, speed: 6, slack: 7, pennation: 8,
  passiveForce: 9, passiveStrain: 10, passiveShape: 11, lengthActivation: 12, tendonStrain: 13, share: 14,
};
const F = FIELD;
const TENDON_SCALE = 0.2;
const TENDON_RISE = 1.791759469228055;
const PASSIVE_ONSET = 0.05;

/** f_v over v [m/s], positive in lengthening: equation (4) of the source paper. */
export function forceVelocity(v, p) {
  const top = p[F.speed];
  if (v > 0) return (p[F.product] * top + p[F.plateau] * v) / (p[F.product] * top + v);
  if (v > -top) return (p[F.curvature] * (top + v)) / (p[F.curvature] * top - v);
  return 0;
}

/** Pull along the tendon over F_max, by the projected fiber length, and its slope. */
function pull(along, a, v, p) {
  const l0 = p[F.fiberLength];
  let l = along;
  let cosine = 1;
  if (p[F.pennation] !== 0) {
    if (along <= 0) return { force: 0, slope: 0 };
    const height = l0 * Math.sin(p[F.pennation]);
    l = Math.hypot(height, along);
    cosine = along / l;
  }
  const fv = forceVelocity(v * cosine, p);
  const z = (l - l0 * (1 + p[F.lengthActivation] * (1 - a))) / p[F.width];
  const fl = Math.exp(-z * z);
  let force = a * fl * fv;
  if (l > (1 - PASSIVE_ONSET) * l0 && p[F.passiveForce] !== 0) {
    const strain = l / l0 - 1;
    const within = Math.min(strain, PASSIVE_ONSET) + PASSIVE_ONSET;
    const x = ((within * within) / (4 * PASSIVE_ONSET) + Math.max(strain - PASSIVE_ONSET, 0)) / p[F.passiveStrain];
    force += (p[F.passiveForce] * (Math.exp(p[F.passiveShape] * x) - 1)) / (Math.exp(p[F.passiveShape]) - 1);
  }
  return { force: force * cosine };
}

/** Strain at which an elastic tendon pulls as the muscle does, by bisection to round-off. */
function tendonStrain(a, length, v, p) {
  const slack = p[F.slack];
  const rise = TENDON_RISE / p[F.tendonStrain];
  const excess = (strain) => Math.log(1 + pull(length - slack * (1 + strain), a, v, p).force / TENDON_SCALE) / rise - strain;
  let low = 0;
  let high = 10;
  if (!(excess(0) > 0)) return 0;
  for (let i = 0; i < 200; ++i) {
    const middle = 0.5 * (low + high);
    if (middle === low || middle === high) break;
    if (excess(middle) > 0) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}

/** Tension [N] at a channel's activation, musculotendon length [m] and rate [m/s]. */
export function tension(activation, length, velocity, p) {
  const a = p[F.share] * activation;
  const elastic = p[F.tendonStrain] > 0 && p[F.slack] > 0;
  const strain = elastic ? tendonStrain(a, length, velocity, p) : 0;
  const force = pull(length - p[F.slack] * (1 + strain), a, velocity, p).force;
  return p[F.maxForce] * (elastic ? Math.max(force, 0) : force);
}
