"""How long one row takes through a program over a pipe: written, waited for, written ... as a control asks.

    python3 row_latency.py ROWS COMMAND...    prints median, 99 % and longest in us, and rows a second when many go at once

COMMAND reads lines of time_s, T_front_degC, T_rear_degC, T_room_degC and answers with one line for each.
"""
import math
import subprocess
import sys
import time

count = int(sys.argv[1])
program = subprocess.Popen(sys.argv[2:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, bufsize=0)
answers = open(program.stdout.fileno(), "rb", buffering=65536, closefd=False)


def line(i):
    degC = 25.0 + 5.0 * math.sin(i * 2.0 * math.pi / 3600.0)
    return f"{i},{degC:.3f},{degC + 1.0:.3f},{degC + 2.0:.3f}\n".encode()


program.stdin.write(b"time_s,T_front_degC,T_rear_degC,T_room_degC\n")
program.stdin.write(line(0))
answers.readline()  # names
answers.readline()
waited_us = []
for i in range(1, count + 1):
    row = line(i)
    start = time.perf_counter()
    program.stdin.write(row)
    answer = answers.readline()
    waited_us.append((time.perf_counter() - start) * 1e6)
    if not answer:
        sys.exit("no answer")
program.stdin.close()
program.wait()
waited_us.sort()
many = b"".join([b"time_s,T_front_degC,T_rear_degC,T_room_degC\n"] + [line(i) for i in range(count)])
start = time.perf_counter()
subprocess.run(sys.argv[2:], input=many, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
rows_a_second = count / (time.perf_counter() - start)
print(f"median {waited_us[count // 2]:.0f} us, 99 % {waited_us[count * 99 // 100]:.0f} us, longest {waited_us[-1]:.0f} us; "
      f"{rows_a_second:.0f} rows/s at once")
