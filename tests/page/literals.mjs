// Literals in the page's code that a reader might see: such belong into its texts.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import ts from "typescript";

// Where any word would be read, be it as short as "none".
const shown_properties = new Set([
  "about", "caption", "formatter", "head", "heading", "hover_name", "items", "label", "quantity", "result", "sentences",
  "short", "text", "title", "verdict", "what", "aria-label", "placeholder", "alt",
]);
const shown_arguments = { axis: [1], value_axis: [1], x_axis: [1], two_grids: [2, 3], curve: [0], button: [0, 1], text_in: [1], group_choice: [2], toggle: [1], details_of: [1], select_of: [0], Option: [0], sequence_bar: [0, 1] };
const from_third = new Set(["element"]); // what an element holds

// Symbols and units are the same in all languages.
export const symbol = /^(?:[\s\d.,:;()|/±−+*°→↑↓≡×%<>?=–…·]|µm|mm|min|deg|rpm|µrad|ppm|RMSE|RMS|kB|MB|CCW|CW|IC|SVG|PNG|CSV|ISO|ln|[A-Z](?![A-Za-z])|[a-z](?![A-Za-z])|[▲▼●◆])*$/;

const looks = new Set(["querySelector", "querySelectorAll", "closest", "matches", "startsWith", "endsWith", "includes", "replaceAll"]);

const names_only = (node) => {
  const { parent } = node;
  if (ts.isImportDeclaration(parent) || ts.isLiteralTypeNode(parent) || ts.isCaseClause(parent)) return true;
  if (ts.isElementAccessExpression(parent)) return true;
  if (ts.isPropertyAssignment(parent)) {
    const name = parent.name.text ?? "";
    if (parent.name === node || name === "class" || name === "className") return true;
  }
  // Selectors, and what a text is looked through for.
  if (ts.isCallExpression(parent) && looks.has(parent.expression.getText().split(".").at(-1))) return parent.arguments[0] === node;
  if (ts.isBinaryExpression(parent)) return /^[!=]==$/.test(parent.operatorToken.getText()) || parent.operatorToken.getText() === "in";
  return false;
};

// What holds the literal, through choices, lists, sums and templates.
const holder = (node) => {
  let [inner, outer] = [node, node.parent];
  const through = (one) =>
    ts.isConditionalExpression(one) || ts.isTemplateExpression(one) || ts.isTemplateSpan(one) || ts.isArrayLiteralExpression(one) ||
    ts.isParenthesizedExpression(one) || ts.isSpreadElement(one) || ts.isArrowFunction(one) ||
    (ts.isBinaryExpression(one) && ["+", "??", "||"].includes(one.operatorToken.getText()));
  while (through(outer)) {
    if (ts.isConditionalExpression(outer) && outer.condition === inner) return [null, inner];
    [inner, outer] = [outer, outer.parent];
  }
  return [outer, inner];
};

const is_shown = (node) => {
  const [outer, inner] = holder(node);
  if (outer === null) return false;
  if (ts.isPropertyAssignment(outer)) return shown_properties.has(outer.name.text ?? "");
  if (ts.isCallExpression(outer) || ts.isNewExpression(outer)) {
    const name = outer.expression.getText().split(".").at(-1) ?? "";
    const at = outer.arguments?.indexOf(inner) ?? -1;
    return (shown_arguments[name] ?? []).includes(at) || (from_third.has(name) && at >= 2);
  }
  return false;
};

const text_of = (node) => (ts.isTemplateExpression(node) ? [node.head.text, ...node.templateSpans.map((one) => one.literal.text)].join("0") : node.text);

// Of a text of TypeScript: [{ line, text }].
export const literals_in = (text, name = "file.ts") => {
  const source = ts.createSourceFile(name, text, ts.ScriptTarget.ES2022, true);
  const found = [];
  const visit = (node) => {
    const literal = ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node) || ts.isTemplateExpression(node);
    if (literal && !names_only(node)) {
      const said = text_of(node);
      const phrase = /[A-Za-z]{2,}[,.:;]? +[A-Za-z(]|\s[A-Za-z]{2,}(\s|$)|^[A-Z][a-z]+|[^\x00-\x7f]/.test(said);
      const word = /[A-Za-z]{2}/.test(said) && is_shown(node);
      if ((phrase || word) && !symbol.test(said)) {
        found.push({ line: source.getLineAndCharacterOfPosition(node.getStart()).line + 1, text: said });
      }
    }
    ts.forEachChild(node, visit);
  };
  visit(source);
  return found;
};

// Of all files of a folder but its texts: ["drift/drift.ts:12: Some words"].
export const literals_of = (folder) =>
  readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((one) => one.isFile() && one.name.endsWith(".ts"))
    .map((one) => relative(folder, join(one.parentPath ?? one.path ?? dirname(folder), one.name)))
    .filter((path) => !path.startsWith("texts/"))
    .sort()
    .flatMap((path) =>
      literals_in(readFileSync(join(folder, path), "utf8"), path).map(({ line, text }) => `${path}:${line}: ${text}`),
    );
