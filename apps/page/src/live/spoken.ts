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

export const duration_spoken = (ms: number): string =>
  ms < 90_000 ? `${Math.max(5, 5 * Math.round(ms / 5000))} s` : `${Math.round(ms / 60_000)} min`;
