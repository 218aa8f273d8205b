// The readings of many tests in one table: a row a reading, one test after the other.
import type { Test } from "./all_tests";
import type { Numbers } from "../picture";
import { minutes } from "../drawing/theme";

export const test_numbers = (tests: readonly Test[], quantity: string): Numbers => ({
  columns: [
    { name: "angle_deg", values: tests.flatMap((test) => test.angle_deg) },
    { name: `${quantity || "deviation"}_um`, values: tests.flatMap((test) => test.value_um) },
    { name: "test", values: tests.flatMap((test) => test.angle_deg.map(() => test.name)) },
    {
      name: "test_time_min",
      values: tests.flatMap(({ angle_deg, recording: { time_s } }) =>
        angle_deg.map(() => (time_s === null ? null : minutes(time_s))),
      ),
    },
  ],
});
