// What each kind of plot shows, how it looks if something is wrong, and what the reader does about that.
import { el } from './element.js';

/** Keys of the workbench. */
export const KEYS = [
  ['Space', 'play, pause'],
  [', .', 'one sample back, on (Shift: ten)'],
  ['Home End', 'begin, end of what is shown'],
  ['[ ]', 'trial before, after'],
  ['Z X', 'zoom in, out about the cursor'],
  ['Esc', 'the whole trial'],
  ['1 2 3 0', 'front, side, top, oblique'],
  ['Arrows', 'turn the body (Shift: move it)'],
  ['+ − F', 'nearer, farther, all in view'],
];

const TEXTS = {
  angle: [
    'The joint angle from inverse kinematics.',
    'Steps, spikes or flat stretches: a marker jumped or was missing. An angle that the person cannot reach: a marker on the wrong bone.',
    'Look at the moving model and at the marker rows of the channels at this time. Mend or leave out the stretch.',
  ],
  torque: [
    'The torque that the muscles have to make, from inverse dynamics, beside the torque of the muscles by their law: with the literature’s numbers, with the identified ones, and with those of a fit that never saw this trial.',
    'The identified curve misses the measured one although the literature’s does, too: the loads or the geometry are wrong. The prediction without this trial is far worse than the identified curve: the numbers describe noise.',
    'Check held mass, force plates and clocks of this trial. If only this trial stands out, look at its files before you use the numbers.',
  ],
  load: [
    'The measured force on the person, of a force plate or a handle, in the axes of its file.',
    'A force that does not return to zero, jumps while nothing touches the plate, or points upside down.',
    'Check offset, sign and axes of the plate. The arrow in the moving model has to stand under the foot.',
  ],
  emg: [
    'The raw EMG (grey, least and greatest value in short stretches, mean removed) and its envelope (orange).',
    'A regular hum at rest, single spikes, a flat line, a top that is cut off, or an envelope that rises where the muscle cannot act.',
    'See the faults of the trial for the remedy. Record a channel that is clipped or flat again.',
  ],
  activation: [
    'The envelope of each channel over the greatest effort of the study: the input of the muscles’ law.',
    'Values above 1, a channel that never rests, or two channels that are copies of each other.',
    'Record maximal contractions if a channel exceeds 1. Check placement of electrodes that move together.',
  ],
  force: [
    'The force of one muscle: shared by optimization (blue, knows no co-contraction), by the law with the literature’s numbers (grey), by the law with the identified numbers (orange).',
    'A force far beyond what the muscle’s size allows. An identified force near zero in a movement that needs the muscle.',
    'Look at the verdict of the muscle’s maximal force. Where it is not identified, the sharing between muscles is not known either.',
  ],
  curves: [
    'Force over length and over velocity: the literature’s muscle, the identified one with its 95 % band, and, of a virtual person, the truth. The grey range was visited by the recording.',
    'A small grey range: outside of it the curve is only the law’s shape. A band as wide as the curve is high.',
    'Read the curves in the grey range only. Record other angles for lengths, faster movements for velocities.',
  ],
  carpet: [
    'All channels at a glance: each row is an EMG channel (share of the greatest effort) or a marker (distance from the model in mm); the stronger the color, the higher. A hatched cell is missing. An orange frame is a fault.',
    'A row that is strong where its neighbors are pale; hatched stretches; stripes over all rows at one time.',
    'Point at a cell for its number, click to move the body there. A marker that is always far: wrong label or wrong place on the model.',
  ],
  learn: [
    'The torque of this trial if one muscle’s numbers were others. The contours hold the pairs of numbers that the recording allows (inner 50 %, outer 95 %).',
    'You can move far along the contour and the error of the torque hardly changes: this pair of numbers is not identifiable from this recording.',
    'Use the combination that the recording knows, or record the movements that the section “What to record next” names.',
  ],
};

/** The three answers to a kind of plot as an element; null for a kind without. */
export function reading(kind) {
  if (!TEXTS[kind]) return null;
  const [shows, bad, act] = TEXTS[kind];
  const pairs = [['What this shows', shows], ['What bad looks like', bad], ['What to do', act]];
  return el('dl', { className: 'reading' }, ...pairs.flatMap(([dt, dd]) => [el('dt', { textContent: dt }), el('dd', { textContent: dd })]));
}
