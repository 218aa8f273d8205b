// Where the page's data come from, and the only place that knows. Today they are embedded in the page. Later the
// library, compiled to WebAssembly, can answer `try` and `add` through this interface too.
import type { Report } from "./report";
import { t } from "./texts/texts";

export interface Source {
  report(): Report;
}

export const embedded = (page: Document): Source => ({
  report() {
    const text = page.getElementById("report")?.textContent;
    if (!text) throw new Error(t.page_no_data);
    const report = JSON.parse(text) as Report;
    if (report.format !== "ballbar-report 1")
      throw new Error(t.page_no_report({ format: String(report.format) }));
    return report;
  },
});
