// How a deviation is drawn on a circle. The circle of the nominal length is drawn to scale, and a deviation of 1 um as
// long as `magnification` um of it would be: at 1000 times, 10 um on a bar of 100 mm are a tenth of the circle's radius.
// So the radial axis is one of deviations, linear, with -nominal / magnification at the middle of the picture.
import { clean, round_down, round_up } from "../drawing/axes";
import { axes_of_plane, within_turn } from "../drawing/angles";
import { curve, type Dash } from "../drawing/curve";
import { curves_tooltip } from "../drawing/hover";
import type { Choice, Look, Picture, State, Toggle } from "../picture";
import { kept_readings, picked } from "./recording_curves";
import type { Num, Recording } from "../report";
import { base, colours, font, kNarrow_px, legend, shown } from "../drawing/theme";
import { t } from "../texts/texts";

export interface RadialScale {
  magnification: number;
  middle_um: number; // deviation at the middle of the picture
  outside_um: number; // and at its edge
  rings_um: number[]; // where the scale rings are, from the inside
  ring_step_um: number;
}

const magnifications = [100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000] as const;

// Share of the picture's radius that the deviations take, at most, where the magnification is chosen automatically.
const kShare = 0.4;

const radial_scale = (
  least_um: number,
  largest_um: number,
  nominal_um: number,
  chosen: number | null,
): RadialScale => {
  const least = Math.min(0, least_um);
  const largest = Math.max(0, largest_um);
  const span = Math.max(largest - least, 1e-3);
  const magnification = chosen ?? round_down(nominal_um / (span / kShare - largest), [1, 1.5, 2, 3, 5, 7]);
  const middle_um = -nominal_um / magnification;
  const visible_um = largest - Math.max(least, middle_um);
  const step = round_up(Math.max(visible_um, -middle_um * 0.06) / 4);
  const outside_um = clean(Math.max(1, Math.ceil(largest / step)) * step);
  const rings_um: number[] = [];
  for (let k = Math.floor(Math.max(least, middle_um) / step); k * step <= outside_um * (1 + 1e-9); ++k) {
    if (k * step > middle_um + 0.3 * step) rings_um.push(clean(k * step));
  }
  return { magnification, middle_um, outside_um, rings_um, ring_step_um: step };
};

// The angle at which the rings' names hide least of curves that cover `angles_deg` (any turn): about the middle of the
// widest gap, else anywhere, but always between two spokes, which are 30 deg apart.
const free_angle_deg = (angles_deg: readonly number[]): number => {
  const covered = new Array<boolean>(36).fill(false);
  for (const angle of angles_deg) covered[Math.floor(within_turn(angle) / 10) % 36] = true;
  let best = { from: 0, length: 0 };
  for (let from = 0; from < 36; ++from) {
    let length = 0;
    while (length < 36 && !covered[(from + length) % 36]) ++length;
    if (length > best.length) best = { from, length };
  }
  const middle = best.length >= 4 ? (best.from + best.length / 2) * 10 : 75;
  return (Math.round((middle - 15) / 30) * 30 + 15) % 360;
};

// A magnified circle: curves of deviations on a circle of the nominal length, angle 0 at the right, angles rising
// counter-clockwise as in ISO 230-4, rings with their deviations. A reading that the magnification puts beyond the
// middle of the picture is not drawn, and the picture says so.

export interface RoundCurve {
  name: string;
  colour: string;
  dash: Dash;
  width_px: number;
  angle_deg: readonly number[];
  value_um: readonly Num[];
  no_readings?: boolean; // no readings: the rings may be named where it is
  faint?: boolean; // behind the others
  hover_name?: string; // where several curves have one name
}

type Style = Omit<RoundCurve, "angle_deg" | "value_um">;

const kStretches = 720; // of a turn, four points each

export const round_curve = ({ trace }: Recording, values: readonly Num[], style: Style): RoundCurve => {
  const kept = kept_readings(values, kStretches);
  return { ...style, angle_deg: picked(trace?.angle_deg ?? [], kept), value_um: picked(values, kept) };
};

type Scaled = Pick<Round, "first" | "extent_um">;

// Of the nominal length and the deviations of what is drawn; "": as they need it.
const magnification_choice = (drawn: (chosen: State["chosen"]) => Scaled): Choice => ({
  key: "magnification",
  label: t.recordings_magnification,
  values: [
    { value: "", label: t.recordings_automatic },
    ...magnifications.map((m) => ({ value: String(m), label: t.recordings_times({ times: m }) })),
  ],
  initial: "",
  slider: {
    least: magnifications[0],
    most: magnifications[magnifications.length - 1] ?? 1,
    now: (chosen) => {
      const { first, extent_um } = drawn(chosen);
      return radial_scale(...extent_um, nominal_um(first), Number(chosen["magnification"]) || null).magnification;
    },
    text: (times) => t.recordings_times({ times }),
  },
});

const nominal_um = (first: Recording | undefined): number => (first?.nominal_length_mm ?? 100) * 1000;

interface Round {
  first: Recording | undefined; // whose plane and length are those of all
  extent_um: readonly [number, number];
  curves: readonly RoundCurve[];
  toggles: readonly Toggle[];
  marks?: (scale: RadialScale) => Record<string, unknown>[];
  note?: string; // at the right below
  graphic?: readonly Record<string, unknown>[];
}

interface RoundPicture extends Omit<Picture, "zoom" | "choices" | "toggles" | "draw"> {
  choices: readonly Choice[]; // beside that of the magnification
  scaled: (chosen: State["chosen"]) => Scaled; // of what is switched off too, so that the scale stays when a curve goes
  toggles: (chosen: State["chosen"]) => readonly Toggle[];
  round: (state: State) => Omit<Round, "first" | "extent_um" | "toggles"> & Partial<Pick<Round, "toggles">>; // else the same
}

export const round_picture = ({ choices, scaled, toggles, round, ...rest }: RoundPicture): Picture => ({
  ...rest,
  zoom: "none",
  choices: [...choices, magnification_choice(scaled)],
  toggles: ({ chosen }) => toggles(chosen),
  draw: (state) => round_option(state, { ...scaled(state.chosen), toggles: toggles(state.chosen), ...round(state) }),
});

const signed = (value: number): string => `${value > 0 ? "+" : ""}${shown(value)}`;

const rings = (scale: RadialScale, at_deg: number, look: Look, radius_px: number): Record<string, unknown>[] => {
  const c = colours(look.dark);
  const whole_turn = Array.from({ length: 121 }, (_, k) => 3 * k);
  const circle = whole_turn.map((angle) => [0, angle]);
  const nominal = curve("", c.faint, "solid", 1.5, circle, { silent: true, tooltip: { show: false }, z: 1 });
  // Where rings are close only every second, third ... has its deviation written at it; the nominal one always.
  const spacing_px = (scale.ring_step_um / (scale.outside_um - scale.middle_um)) * radius_px;
  const every = Math.max(1, Math.ceil(18 / spacing_px));
  const named = scale.rings_um.filter((ring) => Math.round(ring / scale.ring_step_um) % every === 0);
  const label = { show: true, color: c.faint, fontSize: 11, backgroundColor: c.paper, padding: [1, 2] };
  const names = {
    type: "scatter",
    name: "rings",
    silent: true,
    tooltip: { show: false },
    symbolSize: 0,
    z: 4,
    data: named.map((ring) => ({
      value: [ring, at_deg],
      label: { ...label, formatter: ring === 0 ? "0" : signed(ring) },
    })),
  };
  return [nominal, names].map((series) => ({ ...series, coordinateSystem: "polar" }));
};

const axis_name = (angle: number, plane: string | undefined, narrow: boolean): string => {
  const [a, b] = axes_of_plane(plane);
  const names: Record<number, string> = { 0: `+${a}`, 90: `+${b}`, 180: `−${a}`, 270: `−${b}` };
  const name = names[angle];
  return angle === 360 ? "" : name ? (narrow ? name : `${name}  ${angle}°`) : `${angle}°`;
};

const round_option = (state: State, round: Round): Record<string, unknown> => {
  const { look } = state;
  const { first, curves } = round;
  const scale = radial_scale(...round.extent_um, nominal_um(first), Number(state.chosen["magnification"]) || null);
  const c = colours(look.dark);
  const top = look.still ? 64 : 8;
  const narrow = look.width_px < kNarrow_px;
  const radius = Math.max(40, Math.min(look.width_px / 2 - (narrow ? 42 : 66), (look.height_px - top - 8) / 2 - 26));
  let beyond = 0;
  const lines = curves.map((one) => {
    const data = one.angle_deg.map((angle, i) => {
      const value = one.value_um[i] ?? null;
      if (value !== null && value < scale.middle_um) ++beyond;
      return [value !== null && value >= scale.middle_um ? value : null, within_turn(angle)];
    });
    const drawn = curve(one.name, one.colour, one.dash, one.width_px, data, { coordinateSystem: "polar", z: 3 });
    return {
      ...drawn,
      ...(one.faint ? { z: 2, lineStyle: { ...(drawn["lineStyle"] as object), opacity: 0.3 } } : {}),
      ...(one.hover_name ? { hover_name: one.hover_name } : {}),
    };
  });
  const scale_note = [
    t.recordings_magnified({ times: shown(scale.magnification) }),
    t.recordings_rings({ step: shown(scale.ring_step_um) }),
    ...(beyond > 0 ? [t.recordings_beyond, t.recordings_less_magnification] : []),
  ].join("\n");
  const text = { fontSize: 12, lineHeight: 17, fontFamily: font };
  const angles = curves.filter((one) => !one.no_readings).flatMap((one) => one.angle_deg);
  return {
    ...base(look),
    polar: { center: [look.width_px / 2, top + (look.height_px - top - 8) / 2], radius },
    angleAxis: {
      type: "value",
      min: 0,
      max: 360,
      interval: 30,
      startAngle: 0,
      clockwise: false,
      axisLine: { lineStyle: { color: c.grid } },
      axisTick: { show: false },
      axisLabel: { color: c.ink, margin: 10, formatter: (angle: number) => axis_name(angle, first?.plane, narrow) },
      splitLine: { show: true, lineStyle: { color: c.grid } },
    },
    radiusAxis: {
      type: "value",
      min: scale.middle_um,
      max: scale.outside_um,
      axisLine: { show: false },
      axisTick: { show: false, customValues: scale.rings_um },
      axisLabel: { show: false },
      splitLine: { show: true, lineStyle: { color: c.grid } },
      axisPointer: { show: false },
    },
    tooltip: {
      ...curves_tooltip(look, { drawn: lines, x: 1, y: 0, head: (angle) => `${shown(within_turn(angle), 1)}°`, unit: "µm", turn: true }),
      axisPointer: { type: "line", lineStyle: { color: c.faint, type: "dashed" } },
    },
    legend: legend(state, round.toggles),
    graphic: [
      { type: "text", left: narrow ? 0 : 8, ...(narrow && round.note !== undefined ? { top: 0 } : { bottom: 8 }), silent: true, style: { ...text, text: scale_note, fill: c.faint } },
      ...(round.note === undefined
        ? []
        : [{ type: "text", right: 8, bottom: 8, silent: true, style: { ...text, text: round.note, fill: c.ink, textAlign: "right" } }]),
      ...(round.graphic ?? []),
    ],
    series: [...rings(scale, free_angle_deg(angles), look, radius), ...lines, ...(round.marks?.(scale) ?? [])],
  };
};
