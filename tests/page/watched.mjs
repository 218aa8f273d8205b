import { pathToFileURL } from "node:url";

// Of a file, as browsers write it: Node.js leaves `|` as it is up to version 18.
export const address_of = (path) => pathToFileURL(path).href.replaceAll("|", "%7C");

// What must never happen on a page of this address: errors, dialogs, windows, anything loaded. The list grows.
export const watched = (page, url) => {
  const wrong = [];
  page.on("console", (message) => {
    if (["error", "warn", "warning", "assert"].includes(message.type())) wrong.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => wrong.push(`exception: ${error?.message ?? error}`));
  page.on("dialog", (dialog) => {
    wrong.push(`dialog: ${dialog.message()}`);
    dialog.dismiss().catch(() => {});
  });
  page.on("popup", () => wrong.push("a window was opened"));
  page.on("request", (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) wrong.push(`loaded: ${request.url()}`);
  });
  return wrong;
};

// Chromium asks nobody for anything.
export const kQuiet = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
