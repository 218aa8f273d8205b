// A magnified circle: curves of deviations on a circle of the nominal length, angle 0 at the right, angles rising
// counter-clockwise as in ISO 230-4, rings with their deviations. A reading that the magnification puts beyond the
// middle of the picture is not drawn, and the picture says so.
import { axes_of_plane, within_turn } from "../drawing/angles";
import { curve, type Dash } from "../drawing/curve";
import { hover_text } from "../drawing/hover";
import { free_angle_deg, type RadialScale } from "./magnification";
import type { Look } from "../picture";
import type { Num } from "../report";
import { base, colours, font, kNarrow_px, shown, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";

export interface RoundCurve {
  name: string;
  colour: string;
  dash: Dash;
  width_px: number;
  angle_deg: readonly number[];
  value_um: readonly Num[];
  beside?: boolean; // no readings: the rings may be named where it is
  faint?: boolean; // behind the others
  hover_name?: string; // where several curves have one name
}

const signed = (value: number): string => `${value > 0 ? "+" : ""}${shown(value)}`;

const rings = (scale: RadialScale, at_deg: number, look: Look, radius_px: number): Record<string, unknown>[] => {
  const c = colours(look.dark);
  const whole_turn = Array.from({ length: 121 }, (_, k) => 3 * k);
  const nominal = curve(
    "",
    c.faint,
    "solid",
    1.5,
    whole_turn.map((angle) => [0, angle]),
    {
      silent: true,
      tooltip: { show: false },
      z: 1,
    },
  );
  // Where rings are close only every second, third ... has its deviation written at it; the nominal one always.
  const apart_px = (scale.ring_step_um / (scale.outside_um - scale.middle_um)) * radius_px;
  const every = Math.max(1, Math.ceil(18 / apart_px));
  const named = scale.rings_um.filter((ring) => Math.round(ring / scale.ring_step_um) % every === 0);
  const names = {
    type: "scatter",
    name: "rings",
    silent: true,
    tooltip: { show: false },
    symbolSize: 0,
    z: 4,
    data: named.map((ring) => ({
      value: [ring, at_deg],
      label: {
        show: true,
        formatter: ring === 0 ? "0" : signed(ring),
        color: c.faint,
        fontSize: 11,
        backgroundColor: c.paper,
        padding: [1, 2],
      },
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

export const round_option = (
  look: Look,
  scale: RadialScale,
  plane: string | undefined,
  curves: readonly RoundCurve[],
  marks: readonly Record<string, unknown>[],
): Record<string, unknown> => {
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
  const note = [
    t.recordings_magnified({ times: shown(scale.magnification) }),
    t.recordings_rings({ step: shown(scale.ring_step_um) }),
    ...(beyond > 0 ? [t.recordings_beyond, t.recordings_less_magnification] : []),
  ].join("\n");
  const angles = curves.filter((one) => !one.beside).flatMap((one) => one.angle_deg);
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
      axisLabel: { color: c.ink, margin: 10, formatter: (angle: number) => axis_name(angle, plane, narrow) },
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
      ...tooltip(look),
      trigger: "axis",
      axisPointer: { type: "line", lineStyle: { color: c.faint, type: "dashed" } },
      formatter: hover_text({
        drawn: lines,
        x: 1,
        y: 0,
        head: (angle) => `${shown(within_turn(angle), 1)}°`,
        unit: "µm",
        turn: true,
      }),
    },
    graphic: [
      {
        type: "text",
        left: 8,
        bottom: 8,
        silent: true,
        style: { text: note, fill: c.faint, fontSize: 12, lineHeight: 17, fontFamily: font },
      },
    ],
    series: [...rings(scale, free_angle_deg(angles), look, radius), ...lines, ...marks],
  };
};
