"""What both tests do with HAL: pins by halcmd, and rows given one by one."""
import os
import subprocess
import time

failures = []


def halcmd(*words):
    return subprocess.run(["halcmd", *words], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def pin(name):
    text = halcmd("getp", name)
    return {"TRUE": True, "FALSE": False}.get(text) if text in ("TRUE", "FALSE") else float(text)


def expect(what, found, wanted, within=0.0):
    good = abs(found - wanted) <= within
    print(f"{'ok  ' if good else 'FAIL'} {what}: {found:g}" + ("" if good else f", expected {wanted:g}"), flush=True)
    if not good:
        failures.append(what)


def wait_for(name, wanted, within=0.0):
    """The pin, once it is there; as it is after 5 s."""
    end = time.monotonic() + 5.0
    while abs(pin(name) - wanted) > within and time.monotonic() < end:
        time.sleep(0.01)
    return pin(name)


def load(component, state="z.json", more=(), stderr=None):
    """Starts ballbar-hal as ballbar.hal does. Not by halcmd() above: it would wait for the component to end."""
    subprocess.run(["halcmd", "loadusr", "-Wn", component, os.environ["BALLBAR_HAL"], "--name", component, "--model",
                    "live.toml", "--to", "z", "--state", state, *os.environ["BALLBAR_HAL_OPTIONS"].split(), *more],
                   stderr=stderr, check=True)


def row(component, time_s, T_xi_degC):
    before = pin(f"{component}.rows")
    halcmd("setp", f"{component}.signal.T-xi-degC", str(T_xi_degC))
    halcmd("setp", f"{component}.clock-s", str(time_s))
    expect(f"row at {time_s} s taken", wait_for(f"{component}.rows", before + 1), before + 1)


def process(component):
    """As halcmd knows it: ID, User, name, process, state."""
    for line in halcmd("-s", "show", "comp").splitlines():
        words = line.split()
        if words[2] == component:
            return int(words[3])
    raise SystemExit(f"no component {component}")


def kill(component):
    """As the computer's worst: no signal handler runs."""
    os.kill(process(component), 9)


def finish():
    """Without this file the test has not come to its end, and has failed."""
    with open("result", "w") as file:
        file.write("failed: " + "; ".join(failures) if failures else "passed")
