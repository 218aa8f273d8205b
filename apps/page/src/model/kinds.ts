// What a row of a checked series belongs to: the machine heats or cools, or, of recordings, the direction.
import type { Checked, Num } from "../report";
import { colours, curve_colour } from "../drawing/theme";
import { t } from "../texts/texts";

export interface Kind {
  key: string;
  name: () => string; // with its mark, so that a legend shows more than a colour
  colour: (dark: boolean) => string;
  symbol: string;
  rotate: number; // of the symbol, deg
}

const heating: Kind = { key: "heating", name: () => t.model_heating, colour: (dark) => curve_colour(1, dark), symbol: "triangle", rotate: 0 };
const cooling: Kind = { key: "cooling", name: () => t.model_cooling, colour: (dark) => curve_colour(0, dark), symbol: "triangle", rotate: 180 };
const steady: Kind = { key: "steady", name: () => t.model_steady, colour: (dark) => curve_colour(2, dark), symbol: "circle", rotate: 0 };
const unknown: Kind = { key: "unknown", name: () => t.model_neither, colour: (dark) => colours(dark).faint, symbol: "diamond", rotate: 0 };
const ccw: Kind = { key: "CCW", name: () => "CCW ●", colour: (dark) => curve_colour(0, dark), symbol: "circle", rotate: 0 };
const cw: Kind = { key: "CW", name: () => "CW ▲", colour: (dark) => curve_colour(1, dark), symbol: "triangle", rotate: 0 };
const all_kinds = [heating, cooling, steady, unknown, ccw, cw];

const of_regime = new Map([
  ["warming", heating],
  ["cooling", cooling],
  ["standstill", cooling],
  ["steady", steady],
]);

const kSteady_share = 0.05; // of the steepest slope
const kSame_speed = 0.02; // of the highest

type Series = Checked["series"];

// The usual speed of a regime; stops in which a test is made are short. null: it is not known.
const speed_in = (series: Series, regime: Series["regimes"][number] | undefined): Num => {
  const speed = series.inputs.find(({ role }) => role === "speed")?.values ?? [];
  if (!regime) return null;
  const last = series.regimes[series.regimes.length - 1] === regime;
  const speeds = speed
    .filter((_, row) => {
      const time = series.time_s[row] ?? NaN;
      return time >= regime.from_s && (time < regime.to_s || (last && time <= regime.to_s));
    })
    .filter((value) => value !== null)
    .map(Math.abs)
    .sort((a, b) => a - b);
  return speeds[speeds.length >> 1] ?? null;
};

// The minutes after a change of speed heat or cool as what follows them, and where that tells nothing, by whether the
// speed rose or fell.
const kind_of_change = (series: Series, k: number): Kind => {
  const [before, after] = [series.regimes[k - 1], series.regimes[k + 1]];
  const next = of_regime.get(after?.regime ?? "");
  if (next === heating || next === cooling) return next;
  const then = speed_in(series, before);
  const now = speed_in(series, after) ?? speed_in(series, series.regimes[k]);
  if (then === null || now === null || Math.abs(now - then) <= kSame_speed * Math.max(now, then)) return steady;
  return now > then ? heating : cooling;
};

const kind_of_regime = (series: Series, k: number): Kind => {
  const regime = series.regimes[k]?.regime ?? "";
  if (regime === "after a change of speed") return kind_of_change(series, k);
  // A machine that has not run yet does not cool.
  return k === 0 && regime === "standstill" ? steady : (of_regime.get(regime) ?? unknown);
};

export interface Kinds {
  kinds: readonly Kind[]; // that occur
  of_row: Uint8Array; // place in `kinds`
}

const by_regime = ({ series }: Checked): Kind[] => {
  const kinds = series.regimes.map((_, k) => kind_of_regime(series, k));
  let k = 0;
  return series.time_s.map((time) => {
    while (k + 1 < series.regimes.length && time >= (series.regimes[k + 1]?.from_s ?? Infinity)) ++k;
    const regime = series.regimes[k];
    return (regime && time >= regime.from_s && time <= regime.to_s ? kinds[k] : undefined) ?? unknown;
  });
};

// By the slope of a temperature over a fiftieth of the rows.
const by_slope = ({ series }: Checked, temperature: readonly Num[]): Kind[] => {
  const n = series.time_s.length;
  const reach = Math.max(1, Math.floor(n / 100));
  const slopes = series.time_s.map((_, row): Num => {
    const [from, to] = [Math.max(0, row - reach), Math.min(n - 1, row + reach)];
    const [before, after] = [temperature[from] ?? null, temperature[to] ?? null];
    const seconds = (series.time_s[to] ?? 0) - (series.time_s[from] ?? 0);
    return before === null || after === null || seconds <= 0 ? null : (after - before) / seconds;
  });
  const steepest = slopes.reduce((largest: number, slope) => Math.max(largest, Math.abs(slope ?? 0)), 0);
  return slopes.map((slope) => {
    if (slope === null || steepest === 0) return unknown;
    return Math.abs(slope) < kSteady_share * steepest ? steady : slope > 0 ? heating : cooling;
  });
};

// `temperature`: that the rows are drawn against, where it is one; it counts where the speed's regimes are not known.
const kinds_of_rows = (checked: Checked, temperature: readonly Num[] | null): Kind[] => {
  const { series } = checked;
  if (checked.level === "recording") {
    const direction = series.inputs.find((column) => column.name === "direction")?.values ?? [];
    return series.time_s.map((_, row) => ((direction[row] ?? 1) < 0 ? cw : ccw));
  }
  if (series.regimes.length > 0) return by_regime(checked);
  const any = temperature ?? series.inputs.find((column) => column.unit === "degC")?.values;
  return any ? by_slope(checked, any) : series.time_s.map(() => unknown);
};

export const kinds_of = (checked: Checked, temperature: readonly Num[] | null): Kinds => {
  const of_rows = kinds_of_rows(checked, temperature);
  const present = new Set(of_rows);
  const kinds = all_kinds.filter((kind) => present.has(kind));
  return { kinds, of_row: Uint8Array.from(of_rows, (kind) => kinds.indexOf(kind)) };
};
