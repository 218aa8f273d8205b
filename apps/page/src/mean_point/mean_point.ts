// Where one sensor tells the axial elongation.
import { mean_point_picture } from "./mean_point_picture";
import type { Section } from "../picture";
import type { Report } from "../report";

export const mean_point_section = ({ mean_point }: Report): Section[] =>
  mean_point
    ? [
        {
          id: "mean-point",
          heading: "Mean-value point",
          sentences: [mean_point.conclusion],
          tables: [],
          pictures: [mean_point_picture(mean_point)],
        },
      ]
    : [];
