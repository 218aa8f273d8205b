// Round numbers for scales: 1, 2, 5, 10, 20 ...

// The least round number not below `value`, which is positive.
export const round_up = (value: number, steps: readonly number[] = [1, 2, 5]): number => {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [...steps, 10]) if (step * decade >= value * (1 - 1e-9)) return clean(step * decade);
  return clean(10 * decade);
};

// The largest round number not above `value`, which is positive.
export const round_down = (value: number, steps: readonly number[] = [1, 2, 5]): number => {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [...steps].reverse()) if (step * decade <= value * (1 + 1e-9)) return clean(step * decade);
  return clean(decade);
};

// 0.30000000000000004 is 0.3.
export const clean = (value: number): number => Number(value.toPrecision(12));
