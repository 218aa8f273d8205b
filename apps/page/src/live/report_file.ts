// A page that `report` wrote, or that was saved here: its data, and the files that it may carry.
import type { Report } from "../report";
import { t } from "../texts/texts";

export interface Carried {
  path: string;
  base64: string;
}

// Nothing of the other page is run: it is read as text, never as a document of this one.
const block = (page: Document, id: string): unknown => {
  const text = page.getElementById(id)?.textContent;
  return text ? JSON.parse(text) : null;
};

const is_carried = (one: unknown): one is Carried =>
  typeof one === "object" && one !== null && "path" in one && "base64" in one && typeof one.path === "string" && typeof one.base64 === "string";

export interface ReportFile {
  report: Report;
  files: Carried[];
  data: string[]; // words for DATA, among the files
  model: string; // "": none
}

const texts = (list: unknown): string[] => (Array.isArray(list) ? list.filter((one) => typeof one === "string") : []);

// Throws Error, with what is wrong.
export const read_report_file = (text: string): ReportFile => {
  const page = new DOMParser().parseFromString(text, "text/html");
  let report: unknown;
  let files: unknown;
  try {
    report = block(page, "report");
    files = block(page, "files");
  } catch {
    throw new Error(t.live_bad_page);
  }
  if (typeof report !== "object" || report === null || !("format" in report) || report.format !== "ballbar-report 1") {
    throw new Error(t.live_no_report);
  }
  const inside = (typeof files === "object" && files !== null ? files : {}) as Record<string, unknown>;
  return {
    report: report as Report,
    files: Array.isArray(inside["files"]) ? inside["files"].filter(is_carried) : [],
    data: texts(inside["data"]),
    model: typeof inside["model"] === "string" ? inside["model"] : "",
  };
};
