// Where the page's data come from, and the only place that knows. Today they are embedded in the page. Later the
// library, compiled to WebAssembly, can answer `try` and `add` through this interface too.
import type { Report } from "./report";

export interface Source {
  report(): Report;
}

export const embedded = (page: Document): Source => ({
  report() {
    const text = page.getElementById("report")?.textContent;
    if (!text) throw new Error("The page holds no data: the element with the id report is missing or empty.");
    const report = JSON.parse(text) as Report;
    if (report.format !== "ballbar-report 1")
      throw new Error(`The page's data are no ballbar-report 1: ${String(report.format)}.`);
    return report;
  },
});
