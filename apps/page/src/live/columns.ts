// The dialogue for the columns of a log: shows how the program interprets them, and allows corrections. It opens by
// itself for an ambiguous log.
import { answer_of, type Subject, type Work } from "./runs";
import { button, element, select_of, table_of, text_in } from "../elements/elements";
import { type Group, type Held, last_part } from "./files";
import { type LogWords, options_in, said, with_said, with_word, without_advice } from "./log_words";
import type { Num } from "../report";
import { clamped, micrometres, plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { english, named, t } from "../texts/texts";

// The output of `import --json` for one log.
interface Understood {
  shape: string;
  time: string;
  clock?: boolean; // false: the rows are numbered
  rows: number;
  columns: UnderstoodColumn[];
  first_times_s?: Num[];
  sheets?: string[]; // of a workbook
  targets?: string[];
  remarks: string[];
  faults: { column: string; what: string }[];
  unclear?: string[]; // sentences
}

interface UnderstoodColumn {
  source: string; // its header
  found_unit?: string;
  left_out?: string; // why; then nothing below is there
  name?: string;
  unit?: string; // of the series
  role?: string;
  first?: Num[];
}

export interface ColumnsOf {
  work: Work;
  read(group: Group, as: Pick<Subject, "log" | "targets">): Promise<void>;
}

export interface Columns {
  element: HTMLElement;
  button: HTMLElement; // that opens it
  understand(subject: Subject): Promise<void>; // determines how its log is read; throws Refused
  targets(subject: Subject): string[]; // by their names in the series
  ask(): void; // opens for an ambiguity that was not asked about before
  refused(why: string): string | null; // opens; returns why the log cannot be read; null: there is no log
  forget(): void;
  rewrite(): void; // in another language
}

const kRoles = ["measured", "ambient", "coolant", "structure", "bearing", "mean_point", "housing", "speed", "load", "event"];
const kTimeUnits = ["us", "ms", "s", "min", "h", "d"];
const kEvery = "every";
const kNone = "none"; // no time: the rows are numbered

// "2,5 µm" as the program takes it.
const quantity = (text: string): string => text.replace(/\s+/g, "").replace(",", ".").replace(/[µμ]/, "u");

// A ballbar series needs no dialogue.
const log_in = ({ group, data }: Subject): Held | undefined =>
  group.kind === "series" ? group.files.find(({ path, head }) => path === data[0] && !/"ballbar-series \d/.test(head)) : undefined;

export const columns_with = ({ work, read }: ColumnsOf): Columns => {
  let subject: Subject | null = null; // of a log; null: of none
  let log: Held | null = null;
  let understood: Understood | null = null;
  let of_words = ""; // with which it was understood
  let to_ask = false;
  let fault = "";
  let asked_for: readonly string[] = []; // options that the fault names
  let words: LogWords = []; // as they are chosen now
  let rows: { source: string; role: string; target: boolean }[] = [];

  const box = element("section", { class: "live-columns", role: "dialog", tabindex: "-1" });
  const opener = button("", "", () => (box.hidden ? open() : close()));
  const show_opener = (): void => {
    opener.hidden = subject === null;
    opener.setAttribute("aria-expanded", String(!box.hidden));
  };
  const open = (): void => {
    box.hidden = false;
    show_opener();
    render();
    box.focus({ preventScroll: true });
    box.scrollIntoView({ block: "nearest" });
  };
  const close = (): void => {
    box.hidden = true;
    show_opener();
    opener.focus();
  };
  box.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || work.busy()) return; // then it stops the work
    close();
    event.stopPropagation();
  });

  const say = (option: string, value: string, column: string | null = null): void => {
    words = with_said(words, option, value, column);
  };
  const choice = (name: string, option: string, found: string, values: readonly (readonly [string, string])[]): HTMLElement => {
    const { label, select } = select_of(name, [["", found], ...values], (value) => say(option, value));
    select.value = said(words, option);
    select.dataset.option = option;
    return label;
  };
  const text = (option: string, value: string, hint: string, set: (value: string) => void): HTMLInputElement => {
    const field = element("input", { type: "text", value, placeholder: hint, "data-option": option, spellcheck: "false", autocapitalize: "off", size: "8" });
    field.addEventListener("change", () => set(field.value.trim()));
    return field;
  };
  const labelled = (name: string, field: HTMLElement): HTMLElement => element("label", { class: "choice" }, element("span", {}, name), field);
  const tick = (option: string, checked: boolean, set: (on: boolean) => void): HTMLInputElement => {
    const field = element("input", { type: "checkbox", "data-option": option });
    field.checked = checked;
    field.addEventListener("change", () => set(field.checked));
    return field;
  };

  // A column, an interval of the rows, or what the log itself tells.
  const time_fields = (): HTMLElement[] => {
    const of_column = said(words, "time");
    const stated = of_column !== "" || said(words, kEvery) !== "";
    const found = !understood || stated ? t.live_columns_found : t.live_columns_found_as({ what: understood.clock === false ? t.live_columns_no_clock : plain(understood.time, 60) });
    const headers = [...new Set([...(of_column === "" || of_column === kNone ? [] : [of_column]), ...rows.map(({ source }) => source)])];
    const interval = text(kEvery, said(words, kEvery), "10s", (value) => say(kEvery, quantity(value)));
    const every = labelled(t.live_columns_every, interval);
    const unit = choice(t.live_columns_time_unit, "time-unit", t.live_columns_found, kTimeUnits.map((one) => [one, one]));
    const show = (kind: string): void => {
      every.hidden = kind !== kEvery;
      interval.required = !every.hidden;
      unit.hidden = kind === kEvery || kind === kNone;
    };
    // A header is told from the rest by the sign before it.
    const values = [["", found], [kEvery, t.live_columns_interval], [kNone, t.live_columns_no_clock], ...headers.map((one) => [`:${one}`, plain(one, 60)] as const)] as const;
    const { label, select } = select_of(t.live_columns_time, values, (kind) => {
      say("time", kind.startsWith(":") ? kind.slice(1) : kind === kNone ? kNone : "");
      say(kEvery, kind === kEvery ? quantity(interval.value) : "");
      if (kind === kEvery || kind === kNone) say("time-unit", "");
      show(kind);
      if (kind === kEvery) interval.focus();
    });
    select.value = said(words, kEvery) !== "" ? kEvery : of_column === "" || of_column === kNone ? of_column : `:${of_column}`;
    select.dataset.option = "time";
    show(select.value);
    return [label, every, unit];
  };

  const sheet_field = (): HTMLElement[] => {
    const sheets = understood?.sheets;
    if (!sheets) return /\.xlsx$/i.test(log?.path ?? "") ? [labelled(t.live_columns_sheet, text("sheet", said(words, "sheet"), "1", (value) => say("sheet", value)))] : [];
    return [choice(t.live_columns_sheet, "sheet", t.live_columns_found, sheets.map((one) => [one, plain(one, 60)]))];
  };

  // Of a circle whose file does not state it.
  const radius_field = (): HTMLElement[] =>
    asked_for.includes("radius") || said(words, "radius") !== ""
      ? [labelled(t.live_columns_radius, text("radius", said(words, "radius"), "100mm", (value) => say("radius", quantity(value))))]
      : [];

  const log_fields = (): HTMLElement => {
    const listed = (names: Readonly<Record<string, string>>): [string, string][] => Object.entries(names);
    return element(
      "div",
      { class: "choices" },
      ...sheet_field(),
      ...radius_field(),
      labelled(t.live_columns_header_line, text("header-line", said(words, "header-line"), t.live_columns_found, (value) => say("header-line", value.replace(/\D/g, "")))),
      ...time_fields(),
      choice(t.live_columns_delimiter, "delimiter", t.live_columns_found, listed(t.live_columns_delimiters)),
      choice(t.live_columns_decimal, "decimal", t.live_columns_found, listed(t.live_columns_decimals)),
      choice(t.live_columns_dates, "dates", t.live_columns_found, listed(t.live_columns_orders)),
      labelled(t.live_columns_missing, text("missing", said(words, "missing"), "-999", (value) => say("missing", value))),
      labelled(t.live_columns_skip, tick("skip-bad-rows", words.includes("--skip-bad-rows"), (on) => (words = with_word(words, "--skip-bad-rows", on)))),
    );
  };

  const fields_of = (column: UnderstoodColumn, row: { source: string; role: string; target: boolean }): HTMLElement[] => {
    const { source } = column;
    const leave_out = `--leave-out=${source}`;
    const role = element("select", { "data-option": "role" });
    for (const one of kRoles) role.add(new Option(named(t.roles, one), one));
    const target = tick("target", row.target, (on) => {
      row.target = on;
      if (on) set_role((role.value = "measured"));
    });
    const set_role = (value: string): void => {
      row.role = value;
      row.target = target.checked = value === "measured";
      say("role", value, source);
    };
    role.value = row.role;
    role.addEventListener("change", () => set_role(role.value));
    const found_unit = column.found_unit ?? "";
    // A scale is a unit too: the one that was set last counts.
    const unit = text("unit", said(words, "unit", source) || found_unit, column.unit ?? "", (value) => {
      say("unit", value === found_unit ? "" : value, source);
      say("scale", (scale.value = ""), source);
    });
    const scale = text("scale", said(words, "scale", source), "2.5um", (value) => {
      say("scale", quantity(value), source);
      say("unit", "", source);
      unit.value = found_unit;
    });
    const fields = [target, role, unit, scale];
    const left_out = tick("leave-out", column.left_out !== undefined || words.includes(leave_out), (on) => {
      words = with_word(words, leave_out, on);
      for (const field of fields) field.disabled = on;
    });
    for (const field of fields) field.disabled = left_out.checked;
    left_out.disabled = column.left_out !== undefined && !words.includes(leave_out); // by the log itself
    return [...fields, left_out];
  };

  const table = ({ columns, first_times_s: times = [], clock }: Understood): HTMLElement => {
    const asked = [t.live_columns_target, t.live_columns_role, t.unit, t.live_columns_scale, t.live_columns_left_out];
    const when = (time_s: Num, k: number): string => (clock === false ? t.live_columns_row({ row: k + 1 }) : `${shown(time_s)} s`);
    return table_of({
      title: t.live_columns_table,
      heading: [t.live_columns_header, ...asked, t.live_columns_name, ...times.map(when)],
      rows: columns.map(({ source, name, left_out, first }) => [
        plain(source, 60),
        ...asked.map(() => "-"),
        name === undefined ? plain(without_advice(left_out ?? ""), 60) : plain(name, 60),
        ...times.map((_, k) => shown(first?.[k])),
      ]),
      row(made, k) {
        const [column, row] = [columns[k], rows[k]];
        if (!column || !row) return;
        for (const [at, field] of fields_of(column, row).entries()) {
          field.setAttribute("aria-label", t.live_columns_field({ what: asked[at] ?? "", column: plain(column.source, 60) }));
          made.children[at + 1]?.replaceChildren(field);
        }
      },
    });
  };

  const render = (): void => {
    if (!subject || !log || box.hidden) return;
    const name = plain(last_part(log.name), 80);
    const list = (sentences: readonly string[], kind: string): HTMLElement[] => {
      const told = sentences.map(without_advice).filter((one) => one !== "");
      return told.length === 0 ? [] : [element("ul", { class: kind }, ...told.map((one) => text_in("li", english(clamped(one, 600)))))];
    };
    const now = understood;
    const again = element("button", { type: "submit", class: "act" }, t.live_columns_again);
    const form = element(
      "form",
      {},
      log_fields(),
      ...(now ? [table(now)] : []),
      element("div", { class: "buttons" }, again, button(t.live_columns_reset, t.live_columns_reset_title, () => void reread([], [])), button(t.live_columns_hide, "", close)),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const ticked = rows.filter(({ target }) => target).map(({ source }) => source);
      const all = ticked.length === rows.filter(({ role }) => role === "measured").length;
      const sheet = said(words, "sheet");
      // Another sheet has columns of its own.
      if (sheet !== said(subject?.log ?? [], "sheet")) void reread(with_said([], "sheet", sheet), []);
      else void reread(words, all ? [] : ticked);
    });
    box.setAttribute("aria-label", t.live_columns_of({ name }));
    box.replaceChildren(
      element("h2", {}, t.live_columns_of({ name })),
      ...(fault === "" ? [] : [element("p", { class: "fault", role: "alert", lang: "en" }, fault)]),
      ...(now && fault === "" ? list(now.unclear ?? [], "unclear") : []),
      ...(now ? [element("p", { class: "note" }, t.live_columns_rows({ rows: now.rows }), ", ", element("span", { lang: "en" }, micrometres(plain(now.shape, 200))))] : []),
      ...(now ? list([...now.remarks, ...now.faults.map(({ column, what }) => `${column}: ${what}.`)], "note") : []),
      form,
    );
  };

  const reread = async (log_words: LogWords, targets: readonly string[]): Promise<void> => {
    if (!subject) return;
    await read(subject.group, { log: log_words, targets });
    // The field that had the focus is gone.
    if (!box.hidden && document.activeElement === document.body) box.querySelector<HTMLElement>("button[type=submit]")?.focus({ preventScroll: true });
  };

  // To the first field of these options.
  const focus_field = (options: readonly string[]): void => {
    for (const option of options.flatMap((one) => (one === kEvery ? [kEvery, "time"] : [one]))) {
      const fields = [...box.querySelectorAll<HTMLElement>(`[data-option="${option}"]:not(:disabled)`)];
      const field = fields.find((one) => one.closest("[hidden]") === null);
      if (field) return field.focus();
    }
  };

  const made: Columns = {
    element: box,
    button: opener,
    async understand(next) {
      const of_next = log_in(next);
      if (of_next?.path !== log?.path) {
        box.hidden = true;
        understood = null;
        of_words = "";
        rows = [];
      }
      subject = of_next ? next : null;
      log = of_next ?? null;
      fault = "";
      words = next.log;
      show_opener();
      if (!of_next) return;
      const read_so = with_said(next.log, "max-gap", ""); // of signals, once they are read
      const asked = [of_next.path, ...read_so].join("\n");
      if (of_words !== asked) {
        const ran = await work.run(["import", of_next.path, ...read_so, "--json"], { what: () => t.live_checking({ name: plain(last_part(of_next.name), 60) }) });
        understood = answer_of<Understood>(ran);
        of_words = asked;
        to_ask = (understood.unclear ?? []).length > 0;
      }
      const measured = understood?.targets;
      rows = (understood?.columns ?? []).map(({ source, name = "", role = "event" }) => ({
        source,
        role,
        target: next.targets.length > 0 ? next.targets.includes(source) : measured ? measured.includes(name) : role === "measured",
      }));
      render();
    },
    targets: ({ targets }) => (understood?.columns ?? []).flatMap(({ source, name }) => (name !== undefined && targets.includes(source) ? [name] : [])),
    ask() {
      if (!to_ask || !subject) return;
      to_ask = false;
      open();
      if (understood?.clock === false) focus_field(["time"]);
    },
    refused(why) {
      if (!subject || !log) return null;
      asked_for = options_in(why);
      fault = clamped(without_advice(why.replace(log.path, last_part(log.name))), 600) || t.live_columns_unread;
      open();
      focus_field(asked_for);
      return fault;
    },
    forget() {
      subject = log = understood = null;
      of_words = "";
      box.hidden = true;
      show_opener();
    },
    rewrite() {
      opener.textContent = t.live_columns;
      opener.title = t.live_columns_title;
      render();
    },
  };
  box.hidden = true;
  made.rewrite();
  show_opener();
  return made;
};
