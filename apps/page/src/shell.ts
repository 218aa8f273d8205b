// The page around the data: page.html, whose marks are filled in once. The program fills the same file.
import shell from "./page.html";
import type { Report } from "./report";

export type Marks = Readonly<Record<string, string>>;

export const filled = (marks: Marks): string =>
  shell.replace(/@([A-Z_]+)@/g, (_, name: string) => {
    const text = marks[name];
    if (text === undefined) throw new Error(`page.html has a mark that nothing fills: ${name}`);
    return text;
  });

const as_html = (text: string): string =>
  text.replace(/[<>&"]/g, (sign) => `&#${sign.charCodeAt(0)};`).replace(/[\u0000-\u001f]/g, " ");

// JSON that is also harmless within <script>: no "<" to end or comment it.
const as_script = (value: unknown): string => JSON.stringify(value).replaceAll("<", "\\u003c");

const block = (id: string, value: unknown): string =>
  `<script type="application/json" id="${id}">${as_script(value)}</script>\n`;

// Files to go on with in a page that carries the engine; base64, for a file may hold any bytes.
export interface Inside {
  files: { path: string; base64: string }[];
  data: string[]; // the words for DATA
  model?: string;
  log?: string[]; // words for how a log is read
}

// A page of a report, with the style and the script of the page that is open.
export const report_page = (page: Document, report: Report, inside: Inside | null): string => {
  const text = (selector: string): string => page.querySelector(selector)?.textContent ?? "";
  const packed = page.querySelector<HTMLElement>("#page-script"); // unpacked since
  const policy = page.querySelector("meta[http-equiv]")?.getAttribute("content") ?? "";
  const hash = (kind: string): string => new RegExp(`${kind}-src '(sha256-[^']+)'`).exec(policy)?.[1] ?? "";
  return filled({
    CHARSET: "utf-8",
    SCRIPT_HASH: packed?.dataset["hash"] ?? hash("script"),
    STYLE_HASH: hash("style"),
    ENGINE_SCRIPTS: "",
    ENGINE_WORKERS: "",
    MADE_BY: as_html(report.made_by),
    TITLE: as_html(report.title),
    STYLE: text("head > style"),
    SCRIPT: packed?.textContent ?? text("body > script:not([type])"),
    CARRIED: block("report", report) + (inside ? block("files", inside) : ""),
  });
};
