// A page with errors of a machine that are made up here, put in place of the program's, so that a test knows each number
// and each name.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { folder } from "./reports.mjs";

const block = /(<script type="application\/json" id="report">)(.*?)(<\/script>)/s;

export const data_of = (path) => JSON.parse(block.exec(readFileSync(path, "utf8"))[2]);

// The page, with other data.
export const page_with = (name, path, data) => {
  const out = join(folder, `${name}.html`);
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  writeFileSync(out, readFileSync(path, "utf8").replace(block, (_, begin, __, end) => begin + json + end));
  return out;
};

const radians = (degrees) => (degrees * Math.PI) / 180;
const sign = ({ direction }) => (direction === "CCW" ? 1 : -1);

// What each adds to a recording, um, at an angle t.
const shapes = {
  squareness: () => (t) => -0.9 * Math.sin(2 * t),
  backlash_a: (recording) => (t) => (sign(recording) * Math.sign(Math.sin(t)) * Math.cos(t) * 1.4) / 2,
  straightness_b: () => (t) => -0.1 * Math.cos(3 * t),
};

const row = (name, effect, more) => ({
  name,
  ...(effect ? { effect } : {}),
  value: 1.25,
  sigma: 0.125,
  unit: "um",
  significant: true,
  predicts_other_run: true,
  individual_circularity_um: null,
  share_percent: null,
  rank: null,
  stored: null,
  stored_rank: null,
  circularity_without_um: null,
  circularity_gain_um: null,
  circularity_gain_sigma_um: null,
  ...more,
});

const backlash = { individual_circularity_um: 1.4, share_percent: 27.5, rank: 2, circularity_without_um: 3.21, circularity_gain_um: 1.41, circularity_gain_sigma_um: 0.2, remedy: "Adjust the backlash in the control." };

const page_of = (effect, summary, confused_with) => ({
  effect, summary, cause: `Cause of ${effect}.`, signature: `Form of ${effect}.`, confused_with, separated_by: `Test of ${effect}.`, remedy: `Remedy of ${effect}.`,
});

// Of recordings at these places of `fit`, as `ballbar report` writes it. `renamed` gives other names to effects.
export const part_of = ({ fit }, places, renamed = {}) => {
  const name_of = (name) => renamed[name] ?? name;
  const at = (values_of) => places.map((k) => fit.recordings[k].trace.angle_deg.map((angle) => Number(values_of(fit.recordings[k])(radians(angle)).toFixed(6))));
  const { centre_a_um: a, centre_b_um: b, radius_mm, nominal_length_mm, file } = fit.recordings[places[0]];
  return {
    files: [file],
    file: { machine: "Mill 7", operator: "N. N.", started_s: 1713260700, programmed_feed_mm_per_min: 2000 },
    recordings: places,
    errors: [
      // Not in the order of their ranks; what is not significant has the largest circularity.
      row(name_of("straightness_b"), name_of("straightness_b"), {
        value: -0.2, sigma: 0.3, significant: false, predicts_other_run: false, individual_circularity_um: 1.9, share_percent: 37.3, circularity_without_um: 4.55,
      }),
      row("backlash_a_pos", name_of("backlash_a"), { ...backlash, value: 1.4, stored: 1.37, stored_rank: 2 }),
      row("backlash_a_neg", name_of("backlash_a"), { ...backlash, value: -0.4, stored: -0.41, stored_rank: 2 }),
      row(name_of("squareness"), name_of("squareness"), {
        value: 18.04, sigma: 1.46, unit: "um/m", individual_circularity_um: 1.8, share_percent: 35.3, rank: 1, as_instrument: { value: 17.68, rank: 1 }, stored: 17.63, stored_rank: 1,
        circularity_without_um: 2.87, circularity_gain_um: 1.75, circularity_gain_sigma_um: null, remedy: "Square the axes.",
      }),
      row("centre_a", null, { value: a, sigma: 0.05, stored: 1.5 }),
      row("global_scale", null, { value: 0.5, sigma: 0.04 }),
    ],
    circularity_um: 4.62,
    circularity_without_all_um: 1.52,
    residual_rms_um: 0.576,
    repeatability_um: 0.443,
    undetermined: ["scale_mismatch with straightness_b, centre_a"],
    prior: [{ name: "lateral_play_a_pos", sigma: 2, unit: "um" }, { name: "(backlash_b_pos-backlash_b_neg)/2", sigma: 1.5, unit: "um" }],
    conclusion: "Squareness is the largest error.",
    left: null,
    left_text: "All of them together leave 0.58 um rms; CCW and CW repeat to 0.44 um. Unexplained is a wave of 6 a turn.",
    tolerances: ["pass: circularity 4.6 um, tolerance 10 um"],
    circle_um: at(() => (t) => a * Math.cos(t) + b * Math.sin(t) + (radius_mm - nominal_length_mm) * 1000),
    curves: Object.fromEntries(Object.entries(shapes).map(([name, shape]) => [name_of(name), at(shape)])),
    pages: [
      page_of(name_of("squareness"), "The two axes are not at a right angle.", ["servo_mismatch"]),
      page_of("backlash_a", "Play of axis X.", ["reversal_spike_a", "centre_drift"]),
    ],
  };
};

// One test of each pair of recordings of a page of `ballbar report`.
export const with_errors = (name, path, renamed) => {
  const data = data_of(path);
  const parts = data.fit.pairs.map((pair) => part_of(data, pair, renamed));
  return page_with(name, path, { ...data, machine_errors: parts, summary: parts.length === 1 ? [parts[0].conclusion] : data.summary });
};
