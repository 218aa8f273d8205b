// Where one sensor tells the axial elongation.
import { mean_point_picture } from "./mean_point_picture";
import { command_of } from "../drawing/command";
import type { Section } from "../picture";
import type { MeanPointPart, Report } from "../report";
import { shown } from "../drawing/theme";
import { english, language, t, type Said } from "../texts/texts";

// In English the program's own sentences.
const verdict_of = ({ conclusion, best, states }: MeanPointPart): Said => {
  if (language === "en") return english(conclusion);
  if (best) return t.mean_point_says_best({ at: shown(best.x_mm, 1) });
  const [first] = states;
  const places = (first?.mean_points ?? []).map(({ x_mm }) => shown(x_mm, 1)).join("; ");
  return places === "" ? english(conclusion) : t.mean_point_says({ mean: shown(first?.mean_degC, 2), places });
};

export const mean_point_section = ({ mean_point }: Report): Section[] =>
  mean_point
    ? [
        {
          id: "mean-point",
          heading: t.mean_point,
          result: 
            mean_point.best
              ? t.mean_point_result({ at: shown(mean_point.best.x_mm, 1) })
              : t.mean_point_states({ n: mean_point.states.length }),
          first: {
            picture: "mean-point",
            kind: "",
            label: "",
            told: () => ({
              verdict: verdict_of(mean_point),
              concluded: mean_point.conclusion,
              next: { label: t.mean_point_next, text: "", command: command_of("effects", ["mean_point_expansion"]) },
            }),
          },
          sentences: [english(mean_point.conclusion)],
          tables: [],
          pictures: [mean_point_picture(mean_point)],
        },
      ]
    : [];
