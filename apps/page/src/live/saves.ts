// What can be kept: the report as a page, the same with its files to go on from, the model, the drift, any file.
import { last_part } from "./files";
import type { Subject } from "./runs";
import { button, details_of, element } from "../elements/elements";
import type { Report } from "../report";
import type { Inside } from "../shell";
import { save } from "../figure/files";
import { plain, slug } from "../drawing/text";
import { t } from "../texts/texts";

export interface SavesOf {
  subject(): Subject | null;
  report(): Report | null;
  page_with(report: Report, inside: Inside | null): string;
  bytes_of(path: string): Promise<Uint8Array>;
  model_text(subject: Subject): Promise<string>; // of its file, with fitted values
  table_of(subject: Subject): Promise<Uint8Array | string>; // of the drift, or why not
  fault(text: string): void;
}

export interface Saves {
  element: HTMLElement;
  renew(): void;
}

// In pieces: a call takes only so many arguments.
const base64_of = (bytes: Uint8Array): string => {
  let signs = "";
  for (let at = 0; at < bytes.length; at += 32768) signs += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(signs);
};

export const saves_of = (of: SavesOf): Saves => {
  const menu = element("div", { class: "menu" });
  const box = details_of("live-saves", t.live_save, menu);
  const html = (text: string): Blob => new Blob([text], { type: "text/html" });
  const name = (): string => slug(of.report()?.title ?? "") || "ballbar";
  const entry = (label: string, title: string, act: () => Promise<void>): HTMLElement =>
    button(label, title, () => {
      box.open = false;
      act().catch((error: unknown) => of.fault(t.live_not_saved({ why: String(error instanceof Error ? error.message : error) })));
    });

  // Paths as they are here: dropped on this page again, the files go into a folder of their own.
  const inside_of = async ({ group, data, model, log }: Subject): Promise<Inside> => {
    const paths = [...new Set([...group.files.map(({ path }) => path), ...(model === "" ? [] : [model])])];
    const files = await Promise.all(paths.map(async (path) => ({ path, base64: base64_of(await of.bytes_of(path)) })));
    return { files, data: [...data], ...(model === "" ? {} : { model }), ...(log.length === 0 ? {} : { log: [...log] }) };
  };

  return {
    element: box,
    renew() {
      const subject = of.subject();
      const report = of.report();
      box.hidden = !report;
      if (!report) return menu.replaceChildren();
      const entries = [
        entry(t.live_save_report, t.live_save_report_title, async () => save(`${name()}.html`, html(of.page_with(report, null)))),
      ];
      if (subject && subject.group.files.length > 0) {
        entries.push(
          entry(t.live_save_all, t.live_save_all_title, async () =>
            save(`${name()}-with-files.html`, html(of.page_with(report, await inside_of(subject)))),
          ),
        );
      }
      if (subject && subject.model !== "") {
        const { model } = subject;
        entries.push(
          entry(t.live_save_model, t.live_save_model_title, async () => save(last_part(model), new Blob([await of.model_text(subject)]))),
        );
      }
      if (subject && report.drift) {
        entries.push(
          entry(t.live_save_drift, t.live_save_drift_title, async () => {
            const table = await of.table_of(subject);
            if (typeof table === "string") throw new Error(table);
            save(`${name()}-drift.csv`, new Blob([new Uint8Array(table)], { type: "text/csv" }));
          }),
        );
      }
      for (const { path, name: shown } of subject?.group.files ?? []) {
        const file = last_part(shown);
        entries.push(entry(plain(file, 60), t.live_save_file({ name: plain(file, 60) }), async () => save(last_part(path), new Blob([new Uint8Array(await of.bytes_of(path))]))));
      }
      menu.replaceChildren(...entries);
    },
  };
};
