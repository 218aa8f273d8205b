// Where the data of a page come from that `report` wrote: embedded in it. A live page asks the program (live).
import type { Report } from "./report";
import { t } from "./texts/texts";

export interface Source {
  holds(): boolean;
  report(): Report;
}

export const embedded = (page: Document): Source => ({
  holds: () => page.getElementById("report") !== null,
  report() {
    const text = page.getElementById("report")?.textContent;
    if (!text) throw new Error(t.page_no_data);
    const report = JSON.parse(text) as Report;
    if (report.format !== "ballbar-report 1")
      throw new Error(t.page_no_report({ format: String(report.format) }));
    return report;
  },
});
