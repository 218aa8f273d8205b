// The recordings of the ballbar: each on its circle and unrolled, all of a kind over each other, and their results.
import { all_round_picture, all_unrolled_picture } from "./all_tests_pictures";
import { axial_picture } from "./axial_picture";
import { circle_picture } from "./circle_picture";
import { command_of, data_files } from "../drawing/command";
import { capital, plain } from "../drawing/text";
import { range_text } from "../drawing/theme";
import type { Next, Picture, Section } from "../picture";
import { is_axial, is_circle, pairs_and_singles, pairs_of, repeated } from "./recording_groups";
import { recording_tables } from "./recording_tables";
import type { Recording, Report } from "../report";
import { unrolled_picture } from "./unrolled_picture";
import { english, t } from "../texts/texts";

const kFewest_tests = 3; // that are worth a picture of all

const each = (recordings: readonly Recording[]): string[] => recordings.map((_, k) => String(k));

// "10 recordings, circularity 4.62 to 5.13 µm"
const result_of = (recordings: readonly Recording[]): string => {
  const known = recordings.flatMap(({ circularity_um }) => circularity_um ?? []);
  const count = t.recordings_count({ n: recordings.length });
  return known.length === 0 ? count : t.recordings_result({ count, circularity: range_text(known, 2) });
};

const next_of = (report: Report): Next => ({
  label: t.recordings_next,
  command: command_of(report.machine_errors ? "errors" : "diagnose", data_files(report)),
  action: report.machine_errors ? { action: "show", section: "machine-errors" } : { action: "find" },
});

export const recordings_section = (report: Report): Section[] => {
  const { fit } = report;
  if (!fit || (fit.recordings.length === 0 && !fit.stored_alone)) return [];
  const drawn_circles = fit.recordings.filter(is_circle);
  const drawn_axial = fit.recordings.filter(is_axial);
  const groups = pairs_and_singles(drawn_circles, pairs_of(fit));
  const tests = repeated(drawn_circles, kFewest_tests);
  const pictures: Picture[] = [
    ...(groups.length > 0 ? [circle_picture(groups), unrolled_picture(groups)] : []),
    ...(tests.length > 0 ? [all_round_picture(tests), all_unrolled_picture(tests)] : []),
    ...(drawn_axial.length > 0 ? [axial_picture(drawn_axial)] : []),
  ];
  const circles = fit.recordings.filter((recording) => recording.kind === "circle");
  const axial = fit.recordings.filter((recording) => recording.kind === "axial");
  const tables = recording_tables(fit, circles, axial, {
    circle:
      circles.length === drawn_circles.length
        ? { picture: "recording-circle", key: "recording", values: each(circles) }
        : undefined,
    axial:
      axial.length === drawn_axial.length && axial.length > 1
        ? { picture: "axial", key: "recording", values: each(axial) }
        : undefined,
  });
  const [first] = pictures;
  return [
    {
      id: "recordings",
      heading: t.recordings,
      result:
        fit.recordings.length > 0
          ? result_of(fit.recordings)
          : (fit.stored_alone ?? []).map(({ file }) => plain(file, 60)).join(", "),
      ...(first
        ? {
            first: {
              picture: first.name,
              conclusion: () => ({ verdict: capital(result_of(fit.recordings)), next: next_of(report) }),
            },
          }
        : {}),
      sentences: fit.remarks.map(english),
      tables,
      pictures,
    },
  ];
};
