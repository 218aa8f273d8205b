// Sizes, times and kinds in the words of the page's language.
import { t, with_decimal_sign } from "../texts/texts";

export const size_spoken = (bytes: number): string =>
  bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : with_decimal_sign(`${(bytes / 1e6).toFixed(1)} MB`);

export const ago_spoken = (ms: number): string => {
  const minutes = Math.round(ms / 60_000);
  if (minutes < 1) return t.live_just_now;
  if (minutes < 60) return t.live_minutes_ago({ count: minutes });
  const hours = Math.round(minutes / 60);
  return hours < 48 ? t.live_hours_ago({ count: hours }) : t.live_days_ago({ count: Math.round(hours / 24) });
};

// "45 s", "12 min", "5 h 20 min", "2 d 3 h": two parts at most.
export const time_spoken = (time_s: number): string => {
  const [large, small, of, part] = time_s < 60 ? ["s", "s", 1, 1] : time_s < 3600 ? ["min", "s", 60, 1] : time_s < 86400 ? ["h", "min", 3600, 60] : ["d", "h", 86400, 3600];
  const parts = Math.round(time_s / Number(part));
  const whole = Math.floor((parts * Number(part)) / Number(of));
  const rest = parts - (whole * Number(of)) / Number(part);
  return rest === 0 ? `${whole} ${large}` : `${whole} ${large} ${rest} ${small}`;
};

export const duration_spoken = (ms: number): string =>
  ms < 90_000 ? `${Math.max(5, 5 * Math.round(ms / 5000))} s` : `${Math.round(ms / 60_000)} min`;
