// Straight lines across a picture, at places of one of its axes. No curve of its own, so that they are there whatever is
// switched off.
export const lines_across = (
  at: readonly ({ xAxis: number } | { yAxis: number })[],
  label: Record<string, unknown>,
  line: { color: string; type: "solid" | "dashed"; width: number },
): Record<string, unknown> => ({
  type: "line",
  name: "",
  data: [],
  silent: true,
  tooltip: { show: false },
  markLine: { symbol: "none", silent: true, label: { ...label, color: line.color }, lineStyle: line, data: at },
});
