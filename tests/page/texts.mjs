// The page's texts as they are in its code, and that code itself: { en, de, zh }, source.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import ts from "typescript";

if (!process.env.BALLBAR_PAGE_SOURCE) throw new Error("expected BALLBAR_PAGE_SOURCE in the environment, as ctest sets it");
export const source = join(process.env.BALLBAR_PAGE_SOURCE, "src");

export const texts = async () => {
  const folder = mkdtempSync(join(tmpdir(), "ballbar-texts-"));
  try {
    const all = {};
    for (const language of ["en", "de", "zh"]) {
      const text = readFileSync(join(source, "texts", `${language}.ts`), "utf8");
      const file = join(folder, `${language}.mjs`);
      const compilerOptions = { module: ts.ModuleKind.ES2022, target: ts.ScriptTarget.ES2022 };
      writeFileSync(file, ts.transpileModule(text, { compilerOptions }).outputText);
      all[language] = (await import(pathToFileURL(file).href))[language];
    }
    return all;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
};

// An argument of a text: any of its names gives a mark, and is remembered.
const asked = (seen) => new Proxy({}, { get: (_, name) => (seen.add(String(name)), `§${String(name)}§`) });

// What an entry says: { said, names } with marks for what it is given.
export const told = (entry) => {
  const names = new Set();
  const said = typeof entry === "function" ? entry(asked(names)) : entry;
  return { said, names: [...names].sort() };
};
