// The page's texts as they are in its code, and that code itself: { en, de, zh, speak, said, explained_by }, source.
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import ts from "typescript";

if (!process.env.BALLBAR_PAGE_SOURCE) throw new Error("expected BALLBAR_PAGE_SOURCE in the environment, as ctest sets it");
export const source = join(process.env.BALLBAR_PAGE_SOURCE, "src");
export const catalogues = join(process.env.BALLBAR_PAGE_SOURCE, "../../formats/messages");

export const { catalogue_of, expect_translated } = await import(join(process.env.BALLBAR_PAGE_SOURCE, "catalogues.mjs"));

export const texts = () => {
  const folder = mkdtempSync(join(tmpdir(), "ballbar-texts-"));
  try {
    const compilerOptions = { module: ts.ModuleKind.CommonJS, target: ts.ScriptTarget.ES2022 };
    for (const inside of ["src/texts", "messages"]) mkdirSync(join(folder, inside), { recursive: true });
    for (const file of readdirSync(join(source, "texts")).filter((name) => name.endsWith(".ts"))) {
      const text = readFileSync(join(source, "texts", file), "utf8");
      writeFileSync(join(folder, "src/texts", file.replace(/ts$/, "js")), ts.transpileModule(text, { compilerOptions }).outputText);
    }
    for (const [from, to] of [[join(source, "texts"), "src/texts"], [catalogues, "messages"]]) {
      for (const file of readdirSync(from).filter((name) => name.endsWith(".toml"))) {
        writeFileSync(join(folder, to, file), `exports.default = ${JSON.stringify(catalogue_of(join(from, file)))};`);
      }
    }
    const of_file = createRequire(join(folder, "src/texts/"));
    const { speak, said, explained_by, in_all_languages } = of_file("./texts.js");
    const [en, de, zh] = in_all_languages((all) => all);
    return { en, de, zh, speak, said, explained_by };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
};

// What an entry says, with marks for its places.
export const told = (entry) => (typeof entry === "function" ? entry(new Proxy({}, { get: (_, name) => `§${String(name)}§` })) : entry);
