// Which effects may be taken for each other before any is added: |cos| between what survives of two effects beside the
// model, of typical shapes. At 1 they draw the same curve, whatever the cause. An effect with many shapes may imitate
// another that cannot imitate it. What this fit cannot tell apart is another question: the table of candidates has it.
import type { Picture, State } from "../picture";
import type { Diagnosed, Num } from "../report";
import { columns_of_rows } from "../drawing/parts";
import { plain } from "../drawing/text";
import { axis, base, colours, kNarrow_px, shown, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";

const kSame = 0.95; // as in the diagnosis
const kLetter_px = 7;
const kNumber_px = 19; // of two digits, with room to the next
const kWritten = 14; // effects, up to which there is room for numbers in the cells

// From light to dark in one hue on paper, from dark to light on a dark page: strong always stands out, and lightness
// alone tells the order.
const scale = (dark: boolean): string[] =>
  dark
    ? ["#1c2530", "#1f3b57", "#22577f", "#2f7fae", "#62abd4", "#b5dcf2"]
    : ["#f4f7fa", "#d3e3f0", "#a3c8e1", "#64a2cc", "#2b78b0", "#0b4a80"];

type Coherence = NonNullable<Diagnosed["coherence"]>;

const drawing = ({ effects, values }: Coherence, { look }: State): Record<string, unknown> => {
  const c = colours(look.dark);
  const names = effects.map((effect) => plain(effect, 44));
  const most_px = look.width_px < kNarrow_px ? 0.44 * look.width_px : Math.max(200, 0.32 * look.width_px);
  const margin_px = Math.min(most_px, 24 + kLetter_px * Math.max(0, ...names.map((name) => name.length)));
  const cell_px = (look.width_px - margin_px - 24) / Math.max(1, effects.length);
  const written = effects.length <= kWritten && cell_px > 30;
  // With little room the columns bear the numbers of the rows.
  const numbered = cell_px < 44;
  // Beside a narrow matrix there is room for the beginnings of the names.
  const letters = look.width_px < kNarrow_px ? Math.floor((margin_px - 24) / kLetter_px) - 2 : 44;
  const rows = numbered ? names.map((name, k) => `${plain(name, letters)}  ${k + 1}`) : names;
  const columns = numbered ? names.map((_, k) => String(k + 1)) : names;
  const roomy = look.width_px > 640;
  const strong = (value: Num, i: number, j: number): boolean => value !== null && i !== j && value > kSame;
  // A cell that is not known is left empty; an effect beside itself says nothing and is empty too.
  // The framed ones are drawn last, so that their neighbours do not hide the frame.
  const cells = values.flatMap((row, i) =>
    row.flatMap((value, j) => {
      if (value === null || i === j) return [];
      const border = strong(value, i, j) ? { borderColor: c.ink, borderWidth: 2 } : { borderColor: c.paper, borderWidth: 1 };
      // Text of the lightness that the cell has not.
      const light_text = look.dark ? value < 0.7 : value > 0.6;
      return [{ value: [j, i, value], itemStyle: border, label: { color: light_text ? "#ffffff" : "#10151a" } }];
    }),
  );
  const category = (place: "x" | "y", data: readonly string[]): Record<string, unknown> => ({
    ...axis(look, "", place),
    type: "category",
    data,
    splitLine: { show: false },
    axisTick: { show: false },
    axisLine: { show: false },
  });
  return {
    ...base(look),
    grid: { left: margin_px, right: 20, top: 52, bottom: numbered ? 30 : 20 + margin_px * 0.6 },
    tooltip: {
      ...tooltip(look),
      trigger: "item",
      formatter: (one: { value?: unknown }) => {
        const [j, i, value] = Array.isArray(one.value) ? (one.value as number[]) : [];
        const note = (value ?? 0) > kSame ? `\n${t.diagnosis_may_be_taken}` : "";
        return `${names[i ?? 0] ?? ""}\n${t.diagnosis_imitated_by({ effect: names[j ?? 0] ?? "" })}\n|cos| ${shown(value, 3)}${note}`;
      },
    },
    visualMap: {
      type: "continuous",
      min: 0,
      max: 1,
      calculable: false,
      hoverLink: false,
      orient: "horizontal",
      left: roomy ? margin_px : "center",
      top: 8,
      itemWidth: 12,
      itemHeight: 160,
      text: roomy ? [t.diagnosis_same_curve, t.diagnosis_nothing_common] : ["1", "0"],
      textStyle: { color: c.ink },
      inRange: { color: scale(look.dark) },
    },
    xAxis: { ...category("x", columns), axisLabel: { color: c.ink, rotate: numbered ? 0 : 40, interval: cell_px < kNumber_px ? 1 : 0 } },
    yAxis: { ...category("y", rows), inverse: true, axisLabel: { color: c.ink, interval: 0 } },
    series: [
      {
        type: "heatmap",
        data: [...cells].sort((a, b) => a.itemStyle.borderWidth - b.itemStyle.borderWidth),
        label: {
          show: true,
          fontSize: 11,
          formatter: ({ value }: { value: [number, number, number] }) => {
            const mark = strong(value[2], value[1], value[0]) ? "≡" : "";
            return written ? `${mark}${shown(value[2], 2)}` : mark;
          },
        },
      },
    ],
  };
};

export const coherence_picture = (coherence: Coherence, name: string): Picture => ({
  name,
  title: t.diagnosis_coherence_title,
  caption: t.diagnosis_coherence_caption,
  about: t.diagnosis_coherence_about,
  height_px: Math.min(760, 190 + 34 * coherence.effects.length),
  rows_of_text: true,
  zoom: "none",
  toggles: () => [],
  draw: (state) => drawing(coherence, state),
  numbers: () =>
    columns_of_rows(coherence.values.flatMap((row, i) => row.map((abs_cos, j) => ({ i, j, abs_cos }))), {
      effect: ({ i }) => coherence.effects[i] ?? "",
      imitated_by: ({ j }) => coherence.effects[j] ?? "",
      abs_cos: ({ abs_cos }) => abs_cos,
    }),
});
