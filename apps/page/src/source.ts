// Where the data of a page come from that `report` wrote: embedded in it. A live page asks the program (live).
import type { Report } from "./report";

export interface Source {
  holds(): boolean;
  report(): Report;
}

export const embedded = (page: Document): Source => ({
  holds: () => page.getElementById("report") !== null,
  report() {
    const text = page.getElementById("report")?.textContent;
    if (!text) throw new Error("The page holds no data: the element with the id report is missing or empty.");
    const report = JSON.parse(text) as Report;
    if (report.format !== "ballbar-report 1")
      throw new Error(`The page's data are no ballbar-report 1: ${String(report.format)}.`);
    return report;
  },
});
