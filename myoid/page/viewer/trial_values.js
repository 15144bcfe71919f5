// One trial of the workbench.
import { clock, numbers } from './decode.js';
import { curve, decimals } from './series.js';

/** A trial as the page uses it; its series are unpacked when it is opened first. */
export class TrialValues {
  constructor(data) {
    this.data = data;
    Object.assign(this, { name: data.name, use: data.use, scene: data.scene, badge: data.badge, remarks: data.remarks, marks: data.marks });
  }

  get plots() {
    if (!this.cache) {
      this.clocks = this.data.clocks.map(clock);
      this.cache = this.data.plots.map((p) => ({ ...p, curves: p.lines.map((line) => curve(line, this.clocks[line.clock])) }));
    }
    return this.cache;
  }

  get carpet() {
    if (!this.rows) {
      this.rows = this.data.carpet.rows.map((row) => {
        const unpacked = numbers(row.value);
        return { ...row, values: unpacked.values, places: Math.min(3, decimals(unpacked.quantum)) };
      });
    }
    return { begin: this.data.carpet.begin, end: this.data.carpet.end, rows: this.rows };
  }

  /** Inputs of the muscles' law. */
  get drives() {
    if (!this.inputs) {
      this.inputs = this.data.drives.map((d) => ({
        activation: numbers(d.activation).values,
        length: numbers(d.length).values,
        velocity: numbers(d.velocity).values,
        arms: d.arms.map((arm) => numbers(arm).values),
      }));
    }
    return this.inputs;
  }

  /** First and last time of anything that is shown. */
  get extent() {
    const ends = this.plots.flatMap((p) => p.curves.flatMap((c) => [c.x[0], c.x[c.x.length - 1]]));
    return ends.length ? [Math.min(...ends), Math.max(...ends)] : [this.data.carpet.begin, this.data.carpet.end];
  }
}
