// A session of `tests` two-arc tests as a machine might log them: the ball drifts, and every reading has noise.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

// Reproducible and about normal: the sum of twelve uniform ones.
const noise_of = (seed) => {
  let state = seed;
  const uniform = () => (state = (state * 16807) % 2147483647) / 2147483647;
  return () => Array.from({ length: 12 }, uniform).reduce((sum, one) => sum + one, -6);
};

const log = (head, drift_um, readings, from_deg, to_deg, sigma_um, noise) => {
  const rows = Array.from({ length: readings }, (_, k) => {
    const angle = from_deg + ((to_deg - from_deg) * (k + 0.5)) / readings;
    const t = (angle * Math.PI) / 180;
    const length = 100 + (drift_um[0] * Math.cos(t) + drift_um[1] * Math.sin(t) + sigma_um * noise()) / 1000;
    return `${(k * 0.02).toFixed(3)},${angle.toFixed(3)},${length.toFixed(6)}`;
  });
  return `${head.map((one) => `# ${one}\n`).join("")}time_s,angle_deg,length_mm\n${rows.join("\n")}\n`;
};

export const session = (folder, { tests, readings, sigma_um = 0.2, title = "Made for a test" }) => {
  mkdirSync(folder, { recursive: true });
  const noise = noise_of(12345);
  let text = `format = "ballbar-session 1"\nmethod = "two_arcs"\ntitle = ${JSON.stringify(title)}\n[bar]\nnominal_length_mm = 100.0\n`;
  for (let k = 0; k < tests; ++k) {
    const rise_um = 30 * (1 - Math.exp(-k / 4));
    const head = (plane) => [
      'format = "ballbar-log 1"', 'kind = "circle"', 'motion = "rotary_axis"', `plane = "${plane}"`, 'moving_ball = "table"',
      "nominal_length_mm = 100.0", 'direction = "CCW"', `elapsed_s = ${600 * k}.0`, "feed_mm_per_min = 2000.0",
    ];
    const write = (name, plane, drift, from, to) =>
      writeFileSync(join(folder, name), log(head(plane), drift, readings, from, to, sigma_um, noise));
    write(`${k}-c.csv`, "XY", [0.2 * rise_um, rise_um], 90, 450);
    write(`${k}-a.csv`, "YZ", [rise_um, 0.1 * rise_um], 0, 180);
    text += `[[test]]\nelapsed_s = ${600 * k}.0\nc_arc = "${k}-c.csv"\na_arc = "${k}-a.csv"\n`;
  }
  writeFileSync(join(folder, "session.toml"), text);
  return folder;
};
