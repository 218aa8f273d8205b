// What each effect answers to a step of its input: how much, and how fast.
import { curve } from "../drawing/curve";
import { decimated } from "../drawing/decimate";
import { hover_text } from "../drawing/hover";
import type { Picture, Toggle } from "../picture";
import type { Checked, Num } from "../report";
import { plain } from "../drawing/text";
import { axis, base, colours, curve_colour, dashes, digits, legend, minutes, shown, tooltip } from "../drawing/theme";
import { unit_shown } from "../drawing/units";
import { x_axis } from "../drawing/two_grids";
import { t } from "../texts/texts";

type Step = Checked["steps"][number];

const name_of = (step: Step, number: (value: Num) => string): string =>
  `${plain(step.effect, 50)}: ${plain(step.input, 40)} ${number(step.from)} → ${number(step.to)} ${unit_shown(plain(step.unit, 20))}`;

// One of a name twice, as two steps in time, would be one in the legend.
const names_of = (steps: readonly Step[], number: (value: Num) => string): string[] => {
  const names = steps.map((step) => name_of(step, number));
  return names.map((name, k) => (names.indexOf(name) === k ? name : `${name} (${k + 1})`));
};

export const steps_picture = (checked: Checked, name: string): Picture => {
  const { steps } = checked;
  const names = names_of(steps, shown);
  const names_in_files = names_of(steps, digits);
  const toggles = steps.map((_, k): Toggle => ({
    key: `step${k}`,
    label: names[k] ?? "",
    colour: (dark) => curve_colour(k, dark),
    mark: k % dashes.length === 0 ? "line" : k % dashes.length === 2 ? "dotted" : "dashed",
    on: true,
  }));
  const times = steps.map((step) => step.time_s.map(minutes));
  return {
    name,
    title: t.model_steps_title,
    caption: t.model_steps_caption,
    about: t.model_steps_about,
    height_px: 360,
    zoom: "own",
    choices: [],
    toggles: () => toggles,
    draw: (state) => {
      const { look, window } = state;
      const drawn = steps.flatMap((step, k) => {
        if (state.hidden.has(`step${k}`)) return [];
        const points = decimated(times[k] ?? [], step.response_um, window, look.width_px);
        return [curve(names[k] ?? "", curve_colour(k, look.dark), dashes[k % dashes.length] ?? "solid", 2, points)];
      });
      const c = colours(look.dark);
      const moment = {
        type: "line",
        name: "",
        data: [],
        silent: true,
        markLine: {
          silent: true,
          symbol: "none",
          label: { show: false },
          lineStyle: { color: c.faint, type: "dashed" },
          data: [{ xAxis: 0 }],
        },
      };
      return {
        ...base(look),
        grid: { left: 64, right: 20, top: look.still ? 64 : 14, bottom: 48 },
        xAxis: x_axis(look, t.model_steps_axis, window, { min: "dataMin", max: "dataMax" }),
        yAxis: axis(look, t.model_added_axis, "y"),
        legend: legend(state, toggles),
        tooltip: {
          ...tooltip(look),
          trigger: "axis",
          formatter: hover_text({ drawn, x: 0, y: 1, head: (at) => `${shown(at, 1)} min`, unit: "µm" }),
        },
        series: [...drawn, moment],
      };
    },
    numbers: () => {
      const same = steps.every(
        (step) =>
          step.time_s.length === steps[0]?.time_s.length && step.time_s.every((t, i) => t === steps[0]?.time_s[i]),
      );
      if (same) {
        return {
          columns: [
            { name: "time_min", values: times[0] ?? [] },
            ...steps.map((step, k) => ({ name: `${names_in_files[k]}_um`, values: step.response_um })),
          ],
        };
      }
      return {
        columns: [
          { name: "time_min", values: times.flat() },
          { name: "response_um", values: steps.flatMap((step) => step.response_um) },
          { name: "effect", values: steps.flatMap((step, k) => step.time_s.map(() => names_in_files[k] ?? "")) },
        ],
      };
    },
  };
};
