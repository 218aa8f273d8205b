// Many machines: the ranking, then a section a machine that needs something, its quantities with what was found.
import { history_picture } from "../history/history_picture";
import { typed } from "../history/history";
import { command_of } from "../drawing/command";
import type { Next, Section } from "../picture";
import type { FleetMachine, Report } from "../report";
import { plain } from "../drawing/text";
import { english, named, t, with_decimal_sign } from "../texts/texts";

const next = (): Next => ({ label: t.fleet_next, command: command_of("history", ["."], ["--all"]), action: null });

const cell = (text: string): string => with_decimal_sign(named(t.fleet_words, text));

// Of a row of the ranking, without the machine.
const row_text = ([, needs = "", found = "", quantity = "", size = ""]: readonly string[]): string =>
  [cell(needs), cell(found), typed(quantity), cell(size)].filter((text) => text !== "-").join(", ");

const machine_section = (machine: FleetMachine, row: readonly string[], k: number): Section => {
  const { label, reason, findings, quantities } = machine;
  const name = `fleet-${k + 1}`;
  const drawn = quantities.length > 0;
  const shown = { name, trend: t.fleet_curve, caption: t.fleet_caption, about: t.fleet_about };
  return {
    id: name,
    heading: plain(label, 80),
    result: row_text(row),
    says: Math.max(0, 4 - k),
    first: drawn ? { picture: name, kind: t.fleet_kind, label: plain(label, 80), conclusion: () => ({ verdict: english(reason), next: next() }) } : undefined,
    sentences: findings.map(english),
    pictures: drawn ? [history_picture(machine, shown)] : [],
  };
};

export const fleet_sections = ({ fleet }: Report): Section[] => {
  if (!fleet) return [];
  return [
    ...fleet.machines.map((machine, k) => machine_section(machine, fleet.rows[k] ?? [], k)),
    {
      id: "fleet",
      heading: t.fleet_ranking,
      result: t.fleet_count({ n: fleet.rows.length }),
      tables: [
        {
          title: t.fleet_ranking,
          heading: fleet.heading.map((name) => named(t.fleet_headings, name)),
          rows: fleet.rows.map(([machine = "", needs = "", found = "", quantity = "", ...rest]) => [
            plain(machine, 80),
            cell(needs),
            cell(found),
            typed(quantity),
            ...rest.map(cell),
          ]),
        },
      ],
    },
  ];
};
