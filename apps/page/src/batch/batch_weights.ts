// How much each batch counts in the regression.
import type { Picture, State } from "../picture";
import type { BatchPart } from "../report";
import { plain } from "../drawing/text";
import { axis, base, colours, curve_colour, shown, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";

const kLabel_px = 46; // that a name needs, lying

export const weights_picture = ({ batches }: BatchPart): Picture => ({
  name: "batch-weights",
  title: t.batch_weights_title,
  caption: t.batch_weights_caption,
  about: "",
  height_px: 240,
  zoom: "none",
  choices: [],
  toggles: () => [],
  draw: ({ look }: State) => {
    const c = colours(look.dark);
    const names = batches.map(({ name }) => plain(name, 16));
    const lying = (look.width_px - 84) / Math.max(1, batches.length) > kLabel_px;
    return {
      ...base(look),
      grid: { left: 64, right: 20, top: 20, bottom: lying ? 32 : 76 },
      tooltip: { ...tooltip(look), trigger: "item", valueFormatter: (value: unknown) => shown(Number(value), 3) },
      xAxis: {
        ...axis(look, "", "x"),
        type: "category",
        data: names,
        splitLine: { show: false },
        axisTick: { show: false },
        axisLabel: { color: c.ink, rotate: lying ? 0 : 55, hideOverlap: true },
      },
      yAxis: { ...axis(look, t.batch_weight, "y"), scale: false, min: 0 },
      series: [
        {
          type: "bar",
          name: t.batch_weight,
          barMaxWidth: 36,
          color: curve_colour(0, look.dark),
          data: batches.map(({ weight }) => weight),
          label: { show: lying, position: "top", color: c.ink, fontSize: 11, formatter: ({ value }: { value: number }) => shown(value, 2) },
        },
      ],
    };
  },
  numbers: () => ({
    columns: [
      { name: "batch", values: batches.map(({ name }) => name) },
      { name: "weight", values: batches.map(({ weight }) => weight) },
    ],
  }),
});
