#!/bin/sh
# Makes every CSV of this folder again: sh make.sh BALLBAR FOLDER [NOISE]
#   BALLBAR  the program
#   FOLDER   where the files go, made if it is not there
#   NOISE    1 if not given: that of the shipped files; any other whole number above 0: other noise, all else the same
set -eu
LC_ALL=C
export LC_ALL
if [ $# -lt 2 ]; then
  echo "usage: sh make.sh BALLBAR FOLDER [NOISE]" >&2
  exit 2
fi
ballbar=$1
folder=$2
noise=${3:-1}
here=$(dirname "$0")
mkdir -p "$folder"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# name | end in min | minute:rpm from then on, or cycle:rpm:run:stop in min | room in degC, every 30 min from the first
# minute. The log begins at minute 0; a first minute below 0 is a warm-up before it.
cat > "$work/plans" <<'PLANS'
b01|240|-90:1500 0:1750 60:500 150:2250|10.4 12.9 14.8 15.5 16.4 16.3 16.5 17.1 17.0 16.8 17.0 16.9
b02|270|-60:2000 0:1000 75:2000 165:2500 210:2000|9.2 11.7 12.9 14.0 14.5 14.8 15.2 15.2 15.3 15.2 15.2 15.5
b03|270|0:2500 75:2250 135:0 225:2500|12.1 13.9 15.0 15.9 16.2 16.3 16.8 16.7 17.2 17.0
b04|240|-60:1000 0:0 60:1250 105:500 180:750 210:1250|13.0 14.6 15.6 16.2 16.5 17.0 16.9 17.0 16.9 16.8 17.4
b05|270|0:500 75:1000 135:0 165:1500 240:500|15.9 17.1 18.0 18.1 18.5 18.3 18.8 18.9 18.9 18.6
b06|270|0:1500 75:0 150:500 240:750|18.7 18.5 19.0 19.5 19.0 19.2 19.4 19.2 19.5 19.1
b07|300|-90:2000 0:0 30:2000 105:0 195:750 240:0 270:1000|19.7 19.5 19.6 19.6 19.5 19.8 20.0 19.7 19.8 19.5 19.6 20.0 19.7 20.0
b08|330|0:2500 45:1500 105:0 180:750 210:0 240:2250 270:2500|23.2 23.0 23.6 23.6 23.6 23.6 23.8 23.5 23.8 23.7 23.6 23.8
b09|240|0:1500 90:750 120:2500 150:2250 210:2500|26.9 27.3 27.0 27.5 27.3 27.5 27.7 27.6 27.9
b10|240|0:2500 45:0 90:2500 135:750 165:500 210:2250|27.3 27.6 27.7 27.9 28.4 28.1 28.1 28.4 28.4
b11|270|0:2000 60:1750 150:2500 225:2000|31.0 31.0 31.0 31.1 31.2 31.2 31.5 31.7 31.7 31.9
b12|270|0:2000 45:0 135:2250 180:500|29.4 29.7 29.9 30.2 30.1 30.6 30.9 30.8 30.9 31.1
b13|330|0:2500 60:1250 90:2500 180:750 270:2000|30.4 30.5 30.5 30.7 30.6 30.8 31.2 31.2 30.9 31.3 31.4 31.2
b14|300|-90:2500 0:2000 90:1500 165:2500 255:1500|30.9 31.0 31.4 31.1 31.5 31.6 31.9 31.8 32.0 32.4 32.5 32.4 32.5 32.6
b15|300|-60:1000 0:2000 45:0 75:1750 150:2500 225:2250 270:2500|28.2 28.4 28.6 28.4 28.7 28.7 28.7 29.0 28.8 28.8 29.3 29.0 29.4
b16|300|0:1500 45:2250 120:0 180:2250 255:0|27.6 27.7 27.9 28.1 28.4 28.2 28.5 28.6 28.6 29.1 28.7
b17|330|0:1000 75:0 150:750 195:2000 255:0|23.2 23.1 23.2 23.1 23.5 23.5 23.5 23.6 23.4 23.6 23.5 23.3
b18|300|0:2500 90:0 120:2000 195:1750|20.7 21.2 20.8 21.0 20.8 20.8 21.1 21.2 21.1 21.2 21.2
b19|270|-90:2500 0:0 30:1750 75:0 120:2000 150:0 225:500|19.4 19.4 19.5 19.6 19.8 20.0 19.8 19.5 19.6 19.4 19.8 19.8 19.8
b20|240|0:500 60:2000 150:2250|15.5 16.7 17.1 17.8 18.1 18.0 18.3 18.1 18.3
b21|240|0:1500 90:1250 165:750 195:1500|13.0 14.2 15.4 15.7 16.2 16.5 16.6 16.4 16.8
b22|240|0:500 60:1250 90:2500 150:1000 210:1750|9.2 11.4 13.2 14.2 14.7 14.8 15.4 15.3 15.4
b23|270|0:1000 60:2500 135:2000 210:1250|8.0 10.2 11.6 12.6 12.8 13.1 13.5 13.8 13.5 13.5
b24|270|0:1500 45:0 75:1250 135:0 225:1500|8.0 10.5 12.1 13.3 13.7 14.1 14.3 14.2 14.4 14.4
test1|300|cycle:2500:2.5:1|27.0 27.1 27.4 27.5 27.2 27.6 27.9 28.0 27.9 28.0 28.0
test2|300|cycle:2000:2.5:1|24.0 24.1 24.6 24.3 24.2 24.6 24.7 24.4 24.9 24.7 24.9
test3|360|0:500 60:0 120:1000 180:0 240:1500 300:0|21.0 21.1 21.1 21.1 21.4 21.4 21.5 21.3 21.6 21.7 21.5 21.7 21.7
PLANS

cat > "$folder/runs.csv" <<'HEAD'
# SIMULATED by ballbar simulate, not measured: the 24 batches to train on, in the order of the year.
# room_degC: mean of T_room_degC over the batch. speed_plan: minute:rpm, which holds until the next minute; minutes
# below 0 are a warm-up before the log begins.
run,room_degC,speed_plan
HEAD

seed=$((1000 * noise))
while IFS='|' read -r name end speed room; do
  # the template with this batch's plan
  awk -v end="$end" -v speed="$speed" -v room="$room" '
    BEGIN {
      if (speed ~ /^cycle:/) {
        split(speed, c, ":")
        for (at = 0; at < end; at += c[3] + c[4]) {
          time = time comma at ", " (at + c[3])
          rpm = rpm comma c[2] ", 0"
          comma = ", "
        }
        first = 0
      } else {
        n = split(speed, steps, " ")
        for (i = 1; i <= n; ++i) {
          split(steps[i], step, ":")
          time = time comma step[1]
          rpm = rpm comma step[2]
          comma = ", "
          if (i == 1) first = step[1]
        }
      }
      n = split(room, degC, " ")
      comma = ""
      for (i = 1; i <= n; ++i) {
        minute = minute comma (first + 30 * (i - 1))
        level = level comma degC[i]
        comma = ", "
      }
    }
    /^time_min = / { $0 = "time_min = [" time "]" }
    /^speed_rpm = / { $0 = "speed_rpm = [" rpm "]" }
    /^end_min = / { $0 = "end_min = " end }
    /^room_min = / { $0 = "room_min = [" minute "]" }
    /^room_degC = / { $0 = "room_degC = [" level "]" }
    { print }' "$here/machine.toml" > "$work/$name.toml"
  "$ballbar" simulate "$work/$name.toml" --seed "$seed" --out "$work/$name" > "$work/said"
  # without the rows of the warm-up
  awk -F, '/^[#t]/ || $1 >= 0' "$work/$name/series.csv" > "$folder/$name.csv"
  case $name in
    b*)
      mean=$(awk -F, '/^#/ { next }
        /^time_s/ { for (i = 1; i <= NF; ++i) if ($i == "T_room_degC") column = i; next }
        { sum += $column; ++rows }
        END { printf "%.2f", sum / rows }' "$folder/$name.csv")
      echo "$name,$mean,$speed" >> "$folder/runs.csv"
      ;;
  esac
  seed=$((seed + 1))
done < "$work/plans"
