# run.csv, 600 rows of simulated values: z = 8 um/krpm, a first order of 20 min, + 4 um/K of the room + noise with a
# memory; the oil does nothing. z.toml: a model of it without the room and with a drift that is not there.
awk 'BEGIN {
  s = 12345; q = 0; h = 0; print "time_s,speed_rpm,T_room_degC,T_oil_degC,z_um";
  for (i = 0; i < 600; ++i) {
    rpm = (int(i / 75) % 2) * (1000 + 500 * int(i / 150));
    room = 20 + 1.5 * sin(i / 37.0) + 0.5 * sin(i / 11.0 + 1);
    oil = 25 + 2 * cos(i / 53.0) + 0.7 * sin(i / 17.0);
    n = 0; for (k = 0; k < 12; ++k) { s = (s * 16807) % 2147483647; n += s / 2147483647; } n -= 6;
    q = 0.8 * q + 0.6 * n;
    h += (rpm / 1000 - h) * (1 - exp(-60 / 1200.0));
    printf "%d,%d,%.3f,%.3f,%.3f\n", 60 * i, rpm, room, oil, 8 * h + 4 * (room - 20) + 0.3 * q;
  }
}' > run.csv
cat > z.toml <<'END'
# What the spindle does.
format = "ballbar-model 1"
target = "z_um"

[[effect]]
name = "speed_heating"   # friction
speed = "speed_rpm"
exponent = 1.0           # held

# once suspected
[[effect]]
name = "linear_drift"
END
