// What can be kept: the report as a page, the same with its files to go on from, the model, the drift, any file.
import type { Subject } from "./commands";
import { button, element } from "../elements/elements";
import type { Report } from "../report";
import { save } from "./save";
import { plain, slug } from "../drawing/text";
import { words } from "./words";

export interface SavesOf {
  subject(): Subject | null;
  report(): Report | null;
  page_with(report: Report, files: readonly { path: string; bytes: Uint8Array }[]): string; // files: none in it
  bytes_of(path: string): Promise<Uint8Array>;
  table_of(subject: Subject): Promise<Uint8Array | string>; // of the drift, or why not
  fault(text: string): void;
}

export interface Saves {
  element: HTMLElement;
  renew(): void;
}

const last = (path: string): string => path.slice(path.lastIndexOf("/") + 1);

export const saves_of = (of: SavesOf): Saves => {
  const menu = element("div", { class: "menu" });
  const box = element("details", { class: "live-saves" }, element("summary", {}, words.save), menu);
  const html = (text: string): Blob => new Blob([text], { type: "text/html" });
  const name = (): string => slug(of.report()?.title ?? "") || "ballbar";
  const entry = (label: string, title: string, act: () => Promise<void>): HTMLElement =>
    button(label, title, () => {
      box.open = false;
      act().catch((error: unknown) => of.fault(words.not_saved(String(error instanceof Error ? error.message : error))));
    });

  const files_of = async (subject: Subject): Promise<{ path: string; bytes: Uint8Array }[]> => {
    const paths = [...new Set([...subject.group.files.map(({ path }) => path), ...(subject.model === "" ? [] : [subject.model])])];
    return Promise.all(paths.map(async (path) => ({ path, bytes: await of.bytes_of(path) })));
  };

  return {
    element: box,
    renew() {
      const subject = of.subject();
      const report = of.report();
      box.hidden = !report;
      if (!report) return menu.replaceChildren();
      const entries = [
        entry(words.save_report, words.save_report_title, async () => save(`${name()}.html`, html(of.page_with(report, [])))),
      ];
      if (subject && subject.group.files.length > 0) {
        entries.push(
          entry(words.save_all, words.save_all_title, async () =>
            save(`${name()}-with-files.html`, html(of.page_with(report, await files_of(subject)))),
          ),
        );
      }
      if (subject && subject.model !== "") {
        const { model } = subject;
        entries.push(
          entry(words.save_model, words.save_model_title, async () => save(last(model), new Blob([new Uint8Array(await of.bytes_of(model))]))),
        );
      }
      if (subject && report.drift) {
        entries.push(
          entry(words.save_drift, words.save_drift_title, async () => {
            const table = await of.table_of(subject);
            if (typeof table === "string") throw new Error(table);
            save(`${name()}-drift.csv`, new Blob([new Uint8Array(table)], { type: "text/csv" }));
          }),
        );
      }
      for (const { path, name: shown } of subject?.group.files ?? []) {
        const file = last(shown);
        entries.push(entry(plain(file, 60), words.save_file(plain(file, 60)), async () => save(last(path), new Blob([new Uint8Array(await of.bytes_of(path))]))));
      }
      menu.replaceChildren(...entries);
    },
  };
};
