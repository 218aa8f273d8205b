// ballbar.html on its way to a reader: served with another charset, saved anew by a mail program with other line ends, it
// begins, opens a test and carries its sample runs as they are.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";
import { folder } from "./reports.mjs";
import { tool } from "./tool.mjs";

const kMost_bytes = 3.9e6;
const kLong = 120_000;

let browser;
let server;
let address;
let charset = "utf-8";
const page_text = readFileSync(tool, "latin1");
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
  server = createServer((_, answer) => answer.writeHead(200, { "content-type": `text/html; charset=${charset}` }).end(readFileSync(tool)));
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  address = `http://127.0.0.1:${server.address().port}/ballbar.html`;
});
after(async () => {
  await browser.close();
  server.close();
});

const opens = async (url) => {
  const page = await browser.newPage();
  const wrong = [];
  page.on("pageerror", (error) => wrong.push(error.message));
  await page.goto(url);
  await page.waitForSelector("html[data-ready]", { state: "attached", timeout: kLong });
  await page.getByRole("button", { name: "hidden-effect", exact: true }).click();
  await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
  const rmse = await page.textContent(".live-fall .rmse");
  assert.deepEqual(wrong, []);
  await page.close();
  return rmse;
};

test("the page has letters alone that every charset has, in lines that mail carries, and is small enough", () => {
  assert.match(page_text, /^[\t\n\x20-\x7e]*$/);
  assert.ok(statSync(tool).size <= kMost_bytes, `${statSync(tool).size} bytes`);
});

test("served as any charset it is the same page", async () => {
  const from_disk = await opens(`file://${tool}`);
  for (const one of ["utf-8", "iso-8859-1", "windows-1252", "shift_jis"]) {
    charset = one;
    assert.equal(await opens(address), from_disk, one);
  }
});

test("saved anew with other line ends, or with a mark of UTF-8, it is the same page", async () => {
  const from_disk = await opens(`file://${tool}`);
  const lines = join(folder, "mailed.html");
  writeFileSync(lines, page_text.replace(/\n/g, "\r\n"), "latin1");
  assert.equal(await opens(`file://${lines}`), from_disk);
  const marked = join(folder, "marked.html");
  writeFileSync(marked, `\u00ef\u00bb\u00bf${page_text}`, "latin1");
  assert.equal(await opens(`file://${marked}`), from_disk);
});
