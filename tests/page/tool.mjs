// ballbar.html as the tests open it, and its engine as they ask it: `ballbar WORDS...` on files in memory.
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";

export const tool = process.env.BALLBAR_HTML;
if (!tool) throw new Error("expected BALLBAR_HTML in the environment: the page with the program in it");

// A file, or a folder with all in it: [path, file on the disk].
export const files_below = (path, disk) =>
  statSync(disk).isDirectory()
    ? readdirSync(disk)
        .filter((name) => !name.startsWith("."))
        .flatMap((name) => files_below(`${path}/${name}`, join(disk, name)))
    : [[path, disk]];

// Base64 goes over by the driver as a string; bytes as numbers would take ten times as long.
export const put = async (tab, path, bytes) => {
  await tab.evaluate(
    async (path, base64) => {
      const signs = atob(base64);
      await window.ballbar.engine.put(path, Uint8Array.from(signs, (sign) => sign.charCodeAt(0)));
    },
    path,
    Buffer.from(bytes).toString("base64"),
  );
};

export const put_below = async (tab, path, disk) => {
  for (const [one, file] of files_below(path, disk)) await put(tab, one, readFileSync(file));
};

// { status, out, err }
export const ran = (tab, words) => tab.evaluate((words) => window.ballbar.engine.run(words), words);

export const read = (tab, path) => tab.evaluate(async (path) => new TextDecoder().decode(await window.ballbar.engine.get(path)), path);
