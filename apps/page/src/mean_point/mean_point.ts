// Where one sensor tells the axial elongation.
import { mean_point_picture } from "./mean_point_picture";
import { command_of } from "../drawing/command";
import type { Section } from "../picture";
import type { Report } from "../report";
import { shown } from "../drawing/theme";

export const mean_point_section = ({ mean_point }: Report): Section[] =>
  mean_point
    ? [
        {
          id: "mean-point",
          heading: "Mean-value point",
          result: mean_point.best ? `${shown(mean_point.best.x_mm, 1)} mm serve all states best` : `${mean_point.states.length} states`,
          first: {
            picture: "mean-point",
            kind: "",
            label: "",
            told: () => ({
              verdict: mean_point.conclusion,
              next: { label: "See the effect it serves", text: "", command: command_of("effects", ["expansion"]) },
            }),
          },
          sentences: [mean_point.conclusion],
          tables: [],
          pictures: [mean_point_picture(mean_point)],
        },
      ]
    : [];
