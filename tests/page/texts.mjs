// The page's texts as they are in its code, and that code itself: { en, de, zh, speak, said, explained_by }, source.
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import ts from "typescript";

if (!process.env.BALLBAR_PAGE_SOURCE) throw new Error("expected BALLBAR_PAGE_SOURCE in the environment, as ctest sets it");
export const source = join(process.env.BALLBAR_PAGE_SOURCE, "src");
export const catalogues = join(process.env.BALLBAR_PAGE_SOURCE, "../../formats/messages");

export const texts = () => {
  const folder = mkdtempSync(join(tmpdir(), "ballbar-texts-"));
  try {
    const compilerOptions = { module: ts.ModuleKind.CommonJS, target: ts.ScriptTarget.ES2022 };
    for (const inside of ["src/texts", "messages"]) mkdirSync(join(folder, inside), { recursive: true });
    for (const file of readdirSync(join(source, "texts"))) {
      const text = readFileSync(join(source, "texts", file), "utf8");
      writeFileSync(join(folder, "src/texts", file.replace(/ts$/, "js")), ts.transpileModule(text, { compilerOptions }).outputText);
    }
    for (const file of readdirSync(catalogues).filter((name) => name.endsWith(".toml"))) {
      const text = JSON.stringify(readFileSync(join(catalogues, file), "utf8"));
      writeFileSync(join(folder, "messages", file), `exports.default = ${text};`);
    }
    const of_file = createRequire(join(folder, "src/texts/"));
    const { speak, said, explained_by } = of_file("./texts.js");
    return { en: of_file("./en.js").en, de: of_file("./de.js").de, zh: of_file("./zh.js").zh, speak, said, explained_by };
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
