// The pictures without a page: outside a browser this draws each as a file.
import type { Picture } from "./picture";
import type { Report } from "./report";
import { sections_of } from "./sections";
import { initial_state, svg_file } from "./still";

const pictures_of = (report: Report): Picture[] => sections_of(report).flatMap((section) => [...section.pictures]);

const names = (report: Report): { name: string; title: string }[] =>
  pictures_of(report).map(({ name, title }) => ({ name, title }));

const svg = (report: Report, name: string, width_px: number, height_px: number): string => {
  const picture = pictures_of(report).find((one) => one.name === name);
  if (!picture) throw new Error(`There is no picture ${name}.`);
  return svg_file(picture, initial_state(picture, false, width_px), width_px, height_px);
};

(globalThis as unknown as Record<string, unknown>)["ballbar_pictures"] = { names, svg };
