// node embed.mjs FOLDER: what build.mjs made there, as FOLDER/page_assets.cpp, which the program is linked with.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const folder = process.argv[2];

// Lines of string literals, which the compiler joins: bytes that are not printable ASCII in octal, of three digits, so
// that no digit after them counts.
const literal = (bytes) => {
  const lines = [];
  for (let begin = 0; begin < bytes.length; begin += 4096) {
    let line = "";
    for (const byte of bytes.subarray(begin, begin + 4096)) {
      const sign = String.fromCharCode(byte);
      if (sign === '"' || sign === "\\") line += "\\" + sign;
      else if (byte >= 32 && byte < 127 && sign !== "?") line += sign;
      else line += "\\" + byte.toString(8).padStart(3, "0");
    }
    lines.push(`    "${line}"`);
  }
  return lines.join("\n");
};

const assets = { kScript: "page.js", kStyle: "page.css", kPictures: "pictures.js", kShell: "src/page.html" };
const ends = { kScript: /<\/script|<!--/i, kStyle: /<\/style/i }; // would end their own element in the page
let text = '// Made by embed.mjs.\n#include "page/page_assets.hpp"\n\nnamespace ballbar::page {\n';
for (const [name, file] of Object.entries(assets)) {
  const bytes = readFileSync(join(folder, file));
  if (ends[name]?.test(bytes)) throw new Error(`${file} would end its own element in the page`);
  const hash = createHash("sha256").update(bytes).digest("base64");
  text += `const std::string_view ${name}(\n${literal(bytes)},\n    ${bytes.length});\n`;
  text += `const std::string_view ${name}Hash("sha256-${hash}");\n`;
}
writeFileSync(join(folder, "page_assets.cpp"), text + "}  // namespace ballbar::page\n");
