// What each effect adds to the model, stacked: what raises it upwards from zero, what lowers it downwards. A drift counts
// from its start, where every effect is taken as zero; a recording from the nominal circle. Up less down is the model.
import { curve, type Point } from "../drawing/curve";
import { first_at } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import { grid_of } from "../drawing/parts";
import type { Look, Picture, State, Toggle } from "../picture";
import { kept_readings } from "../recordings/recording_curves";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Checked, Num, Report } from "../report";
import type { Strand } from "../drawing/strands";
import { labels_once, plain } from "../drawing/text";
import { axis, base, colours, curve_colour, dashes, font, shown, toggle } from "../drawing/theme";
import { in_time, time_limits, whole_of, x_axis } from "../drawing/axes";
import { angle_limits } from "../recordings/unrolled_picture";
import { t } from "../texts/texts";

const kName_px = 12; // size of the names in the bands

// Places of the rows that are drawn: the same for all parts, for they stand on each other.
const places_drawn = ({ strand, parts, model_um }: Stack, window: State["window"], width_px: number): number[] => {
  const from = window ? Math.max(0, first_at(strand.x, window[0]) - 1) : 0;
  const to = window ? Math.min(strand.x.length, first_at(strand.x, window[1]) + 2) : strand.x.length;
  const stretches = width_px / (parts.length + 1);
  const kept = [model_um, ...parts.map((part) => part.values_um)].flatMap((values) =>
    kept_readings(values.slice(from, to), stretches),
  );
  return [...new Set(kept)].sort((a, b) => a - b).map((i) => from + i);
};

// A part's upper or lower half, on those before it.
interface Half {
  series: Record<string, unknown>;
  inner: number[]; // the edge nearer to zero, at each place
  outer: number[];
}

const half_of = (
  part: Part,
  places: readonly number[],
  x: readonly number[],
  inner: readonly number[],
  up: boolean,
  k: number,
  dark: boolean,
): Half => {
  const colour = part.colour(dark);
  const halves = places.map((place): Num => {
    const value = part.values_um[place] ?? null;
    return value === null ? null : up ? Math.max(0, value) : Math.min(0, value);
  });
  // No edge is drawn where the part is all on the other side.
  const points = places.map((place, i): Point => [
    x[place] ?? NaN,
    halves[i] || halves[i - 1] || halves[i + 1] ? (halves[i] ?? null) : null,
  ]);
  const stack = { stack: up ? "up" : "down", stackStrategy: up ? "positive" : "negative" };
  const more = { ...stack, areaStyle: { color: colour, opacity: 0.42 }, silent: true, tooltip: { show: false }, z: 2 };
  return {
    series: curve(part.label, colour, dashes[k % dashes.length] ?? "solid", 1, points, more),
    inner: [...inner],
    outer: inner.map((edge, i) => edge + (halves[i] ?? 0)),
  };
};

const name_at = (text: string, place: Place, look: Look): Record<string, unknown> => {
  const c = colours(look.dark);
  const label = {
    show: true,
    position: "inside",
    formatter: text,
    color: c.ink,
    fontSize: kName_px,
    fontFamily: font,
    textBorderColor: c.paper,
    textBorderWidth: 2,
  };
  return { value: [place.x, place.y], label };
};

export const contributions_picture = (
  report: Report,
  checked: Checked,
  strands: readonly Strand[],
  name: string,
): Picture => {
  const over_angle = checked.level === "recording";
  const stacks = new Map<Strand, Stack>();
  const stack_for = (chosen: State["chosen"]): Stack | null => {
    const strand = chosen_strands(strands, chosen)[0];
    if (!strand) return null;
    const stack = stacks.get(strand) ?? stack_of(checked, strand);
    stacks.set(strand, stack);
    return stack;
  };
  const toggles = (chosen: State["chosen"]): Toggle[] => [
    toggle("model", t.model, 1, "line"),
    ...(stack_for(chosen)?.parts ?? []).map(({ key, label, colour }) => toggle(key, label, colour, "band")),
  ];

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const stack = stack_for(state.chosen);
    if (!stack) return base(look);
    const width = Math.max(100, look.width_px - 84);
    const places = places_drawn(stack, window, width);
    const { x } = stack.strand;
    const parts = stack.parts.filter((part) => !hidden.has(part.key));
    const all: [number, number] = window ? [window[0], window[1]] : [x[0] ?? 0, x[x.length - 1] ?? 1];
    const side = (up: boolean): Half[] => {
      let edge = places.map(() => 0);
      return parts.map((part, k) => {
        const half = half_of(part, places, x, edge, up, k, look.dark);
        edge = half.outer;
        return half;
      });
    };
    const [ups, downs] = [side(true), side(false)];
    const reach_um = [ups, downs].reduce((sum, halves) => sum + largest_of(halves[halves.length - 1]?.outer ?? []), 0);
    const least_um = (1.3 * kName_px * reach_um) / Math.max(100, look.height_px - 120); // that a name needs
    const at = places.map((place) => x[place] ?? NaN);
    const names = parts.flatMap((part, k) => {
      const text = plain(part.label, Math.min(34, Math.floor(width / (kName_px * 0.6))));
      // The ends of a name may stand out of a band that is narrow there.
      const wide = 0.6 * ((text.length * kName_px * 0.6) / width) * (all[1] - all[0]);
      const up = place_for_name(at, ups[k]?.inner ?? [], ups[k]?.outer ?? [], all, wide);
      const down = place_for_name(at, downs[k]?.outer ?? [], downs[k]?.inner ?? [], all, wide);
      const place = (up?.height ?? 0) >= (down?.height ?? 0) ? up : down;
      if (!place || place.height <= least_um) return [];
      const half = ((text.length * kName_px * 0.6) / width) * (all[1] - all[0]) * 0.5;
      return [name_at(text, { ...place, x: Math.min(Math.max(place.x, all[0] + half), all[1] - half) }, look)];
    });
    const model = places.map((place): Point => [x[place] ?? NaN, stack.model_um[place] ?? null]);
    const series: Record<string, unknown>[] = [...ups, ...downs].map((half) => half.series);
    if (!hidden.has("model")) series.push(curve(t.model, curve_colour(1, look.dark), "solid", 2.4, model, { z: 4 }));
    series.push({ type: "scatter", name: "", symbolSize: 0, silent: true, tooltip: { show: false }, data: names, z: 5 });
    const values = parts.map((part) => ({
      name: part.label,
      data: places.map((place) => [x[place] ?? NaN, part.values_um[place] ?? null]),
    }));
    const drawn = [...(hidden.has("model") ? [] : [{ name: t.model, data: model }]), ...values];
    const unit = over_angle ? "°" : "min";
    return {
      ...curves_base(state, toggles(state.chosen), { drawn, head: (at) => `${shown(at, 1)} ${unit}`, unit: "µm" }),
      grid: grid_of(look),
      xAxis: over_angle
        ? x_axis(look, t.angle_axis, window, angle_limits(x))
        : in_time(x_axis(look, t.time_axis, window, time_limits(x)), look, window ?? whole_of(time_limits(x))),
      yAxis: axis(look, over_angle ? t.model_added_axis : t.model_added_since_axis, "y"),
      series,
    };
  };

  return {
    name,
    title: t.model_contributions_title,
    caption: over_angle ? t.model_contributions_caption_angle : t.model_contributions_caption,
    about: t.model_contributions_about,
    height_px: 420,
    zoom: over_angle ? "own" : "time",
    choices: recording_choice(report, strands, false),
    toggles: ({ chosen }) => toggles(chosen),
    draw,
    numbers: ({ chosen }) => {
      const stack = stack_for(chosen);
      if (!stack) return { columns: [] };
      return {
        columns: [
          { name: over_angle ? "angle_deg" : "time_min", values: stack.strand.x },
          { name: "model_um", values: stack.model_um },
          ...stack.parts.map((part) => ({ name: `${part.name}_um`, values: part.values_um })),
        ],
      };
    },
  };
};

interface Part {
  key: string;
  name: string; // in a file
  label: string;
  values_um: readonly Num[]; // at the strand's rows
  colour: (dark: boolean) => string;
}

interface Stack {
  strand: Strand;
  parts: Part[];
  model_um: Num[];
}

const kUnseen_um = 1e-6; // a part that never differs more from zero is none

const largest_of = (values: readonly Num[]): number =>
  values.reduce((largest: number, value) => Math.max(largest, Math.abs(value ?? 0)), 0);

const stack_of = (checked: Checked, strand: Strand): Stack => {
  const { series } = checked;
  const from_start = checked.level === "series";
  const counted = (values: readonly Num[]): Num[] => {
    const at_rows = strand.rows.map((row) => values[row] ?? null);
    const start = from_start ? (at_rows.find((value) => value !== null) ?? 0) : 0;
    return at_rows.map((value) => (value === null ? null : value - start));
  };
  const model_um = counted(series.predicted_um);
  const columns = series.contributions.map(({ values_um }) => counted(values_um));
  // What is in the model and in no effect: a constant.
  const rest = model_um.map((model, i): Num => {
    if (model === null) return null;
    const sum = columns.reduce((total, column) => total + (column[i] ?? 0), 0);
    return Math.abs(model - sum) < 1e-4 * Math.max(1, Math.abs(model)) ? 0 : model - sum;
  });
  const labels = labels_once(series.contributions.map(({ effect }) => plain(effect, 60)));
  const parts = [...columns, rest].map((values_um, k): Part => ({
    key: `part${k}`,
    name: labels[k] ?? "constant",
    label: labels[k] ?? t.model_constant,
    values_um,
    colour: (dark) => curve_colour([2, 3, 4, 5, 6, 7, 0][k % 7] ?? 2, dark),
  }));
  return { strand, parts: parts.filter((part) => largest_of(part.values_um) > kUnseen_um), model_um };
};

// Where a name fits into a band between two curves, so that names of bands that stand on each other cannot overlap.
interface Place {
  x: number; // middle of the name
  y: number;
  height: number; // that is free there
}

const kTried = 40; // places along the band

// The place where a name `width` wide, in units of x, has the most height within the band. x rises.
const place_for_name = (
  x: readonly number[],
  lower: readonly number[],
  upper: readonly number[],
  range: readonly [number, number],
  width: number,
): Place | null => {
  let best: Place | null = null;
  const first = range[0] + width / 2;
  const last = range[1] - width / 2;
  let from = 0;
  for (let k = 0; k <= kTried && last > first; ++k) {
    const middle = first + (k * (last - first)) / kTried;
    while (from < x.length && (x[from] ?? 0) < middle - width / 2) ++from;
    let floor = -Infinity;
    let ceiling = Infinity;
    let points = 0;
    // One point beyond on either side, because the curve runs on to it.
    for (let i = Math.max(0, from - 1); i < x.length; ++i, ++points) {
      floor = Math.max(floor, lower[i] ?? 0);
      ceiling = Math.min(ceiling, upper[i] ?? 0);
      if ((x[i] ?? 0) > middle + width / 2) break;
    }
    const height = ceiling - floor;
    if (points > 0 && height > (best?.height ?? 0)) best = { x: middle, y: (floor + ceiling) / 2, height };
  }
  return best;
};
