// Regimes of the speed as shades behind curves over time.
import type { Toggle } from "../picture";
import type { Checked } from "../report";
import { plain } from "../drawing/text";
import { minutes, regime_colour } from "../drawing/theme";
import { named, t } from "../texts/texts";

type Regimes = Checked["series"]["regimes"];

export const regime_names = (regimes: Regimes): string[] => [...new Set(regimes.map(({ regime }) => regime))];

// A small mark in a legend needs more than a shade.
const stronger = (regime: string, dark: boolean, alpha: number): string =>
  regime_colour(regime, dark).replace(/[\d.]+\)$/, `${alpha})`);

export const regime_toggles = (regimes: Regimes): Toggle[] =>
  regime_names(regimes).map((regime) => ({
    key: `regime ${regime}`,
    label: plain(named(t.regimes, regime), 40),
    colour: (dark) => stronger(regime, dark, 1),
    mark: "band",
    on: true,
  }));

// One series a regime, in each grid; without points, so that only its shade is seen.
export const regime_bands = (
  regimes: Regimes,
  hidden: ReadonlySet<string>,
  dark: boolean,
  grids: number,
): Record<string, unknown>[] =>
  regime_names(regimes)
    .filter((regime) => !hidden.has(`regime ${regime}`))
    .flatMap((regime) =>
      Array.from({ length: grids }, (_, grid) => ({
        type: "line",
        name: plain(named(t.regimes, regime), 40),
        data: [],
        silent: true,
        xAxisIndex: grid,
        yAxisIndex: grid,
        itemStyle: { color: stronger(regime, dark, 0.4) },
        markArea: {
          silent: true,
          itemStyle: { color: regime_colour(regime, dark) },
          data: regimes
            .filter((one) => one.regime === regime)
            .map((one) => [{ xAxis: minutes(one.from_s) }, { xAxis: minutes(one.to_s) }]),
        },
      })),
    );
