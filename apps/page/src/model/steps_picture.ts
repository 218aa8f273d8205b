// What each effect answers to a step of its input: how much, and how fast.
import { curve, lines_across } from "../drawing/curve";
import { decimated, extent } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import type { Picture } from "../picture";
import type { Checked, Num } from "../report";
import { labels_once, plain, unit_shown } from "../drawing/text";
import { axis, colours, curve_colour, dashes, digits, mark_of, minutes, shown, time_text, toggle } from "../drawing/theme";
import { time_limits, x_axis } from "../drawing/axes";
import { columns_of, grid_of } from "../drawing/parts";
import { t } from "../texts/texts";

// One of a name twice, as two steps in time, would be one in the legend.
const names_of = (steps: Checked["steps"], number: (value: Num) => string): string[] =>
  labels_once(
    steps.map(({ effect, input, from, to, unit }) => `${plain(effect, 50)}: ${plain(input, 40)} ${number(from)} → ${number(to)} ${unit_shown(plain(unit, 20))}`),
  );

export const steps_picture = (checked: Checked, name: string): Picture => {
  const { steps } = checked;
  const names = names_of(steps, shown);
  const names_in_files = names_of(steps, digits);
  const toggles = steps.map((_, k) => toggle(`step${k}`, names[k] ?? "", k, mark_of(k)));
  const times = steps.map((step) => step.time_s.map(minutes));
  const limits = time_limits(extent(times));
  return {
    name,
    title: t.model_steps_title,
    caption: t.model_steps_caption,
    about: t.model_steps_about,
    height_px: 360,
    zoom: "own",
    toggles: () => toggles,
    draw: (state) => {
      const { look, window } = state;
      const drawn = steps.flatMap((step, k) => {
        if (state.hidden.has(`step${k}`)) return [];
        const points = decimated(times[k] ?? [], step.response_um, window, look.width_px);
        return [curve(names[k] ?? "", curve_colour(k, look.dark), dashes[k % dashes.length] ?? "solid", 2, points)];
      });
      const moment = lines_across([{ xAxis: 0 }], { show: false }, { color: colours(look.dark).faint, type: "dashed", width: 1 });
      return {
        ...curves_base(state, toggles, { drawn, head: (at) => time_text(at, 1), unit: "µm" }),
        grid: grid_of(look),
        xAxis: x_axis(look, t.model_steps_axis, window, limits),
        yAxis: axis(look, t.model_added_axis, "y"),
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
      return columns_of({
        time_min: times.flat(),
        response_um: steps.flatMap((step) => step.response_um),
        effect: steps.flatMap((step, k) => step.time_s.map(() => names_in_files[k] ?? "")),
      });
    },
  };
};
