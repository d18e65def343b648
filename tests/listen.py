#!/usr/bin/env python3
"""Tests of faintline-cli listen with each of its sources:
    python3 tests/listen.py CLI pipe [HOURS]            at full speed (24): memory, processor time
    python3 tests/listen.py CLI sound|udp|rtl_tcp [MINUTES]   in real time (10); sound needs pulseaudio
    python3 tests/listen.py CLI kill [COUNT]            SIGKILL at random moments (50)
    python3 tests/listen.py CLI drift [PPM]             a sender whose clock is slow by PPM (100); takes 17 minutes
All but kill compare the events with those of detect on the recording, byte for byte. Needs numpy. Exit code 1 if a test fails."""
import collections
import json
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

import numpy

RATE = 48000
BLOCK = RATE // 20  # samples
SETTINGS = ["--set", "spectrogram.windowSeconds=1", "--set", "decide.falseAlarmsPerHour=1"]
MB = 1e6
BEGINNING = 600  # s of each hour excluded from the measurement of memory, because the first contain the calibration


def fail(words):
    sys.exit("error: tests/listen.py: " + words)


class Scene:
    """Noise, and lines that come and go at other frequencies: 16-bit, or I/Q of 8 bits."""

    def __init__(self, isIq=False):
        self.isIq = isIq
        self.random = numpy.random.Generator(numpy.random.SFC64(1))
        self.position = 0

    def block(self, samples=BLOCK):
        t = (self.position + numpy.arange(samples)) / RATE
        self.position += samples
        minute = int(t[0] / 60)
        phase = 2 * numpy.pi * ((300 + 731 * minute % 20000) * t + 0.15 * (t - 60 * minute) ** 2)
        amplitude = 0.004 if t[0] % 60 < 40 else 0.0
        if self.isIq:
            noise = self.random.standard_normal((samples, 2), numpy.float32) * 30
            noise[:, 0] += 30 * 10 * amplitude * numpy.cos(phase)
            noise[:, 1] += 30 * 10 * amplitude * numpy.sin(phase)
            return numpy.clip(127.5 + noise, 0, 255).astype(numpy.uint8).tobytes()
        noise = self.random.standard_normal(samples, numpy.float32) * 0.1
        return (32767 * numpy.clip(noise + amplitude * numpy.cos(phase), -1, 1)).astype("<i2").tobytes()


def cpuSeconds(pid):
    words = open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def memory(pid, kind):
    """Bytes that are resident: VmRSS now, VmHWM the most since that was forgotten."""
    return 1024 * int(re.search(kind + r":\s+(\d+) kB", open(f"/proc/{pid}/status").read())[1])


def forgetMost(pid):
    open(f"/proc/{pid}/clear_refs", "w").write("5")


def listen(cli, folder, source, **more):
    return subprocess.Popen(
        [cli, "listen", *source, *SETTINGS, "--record", f"{folder}/heard.sigmf-meta", "--events", f"{folder}/live.csv",
         "--out", f"{folder}/lines.jsonl"], **more)


def compare(cli, folder):
    """Of the recording, with the same settings and a causal background."""
    subprocess.run([cli, "detect", f"{folder}/heard.sigmf-meta", *SETTINGS, "--set", "noise.causal=true", "--events",
                    f"{folder}/file.csv", "--progress", "none"], check=True)
    live, file = (open(f"{folder}/{name}.csv", "rb").read() for name in ("live", "file"))
    if live != file:
        fail(f"the events of the recording are others: {folder}")
    notices = [json.loads(line) for line in open(f"{folder}/lines.jsonl")]
    told = collections.Counter(n["notice"] for n in notices if n.get("notice") not in (None, "started", "stopped"))
    words = ", ".join(f"{count} of {kind}" for kind, count in told.items()) or "none"
    print(f"{live.count(10) - 1} events, byte for byte those of the recording; notices: {words}", flush=True)


def pipe(cli, folder, hours):
    scene, hourly = Scene(), []
    with open(f"{folder}/hour", "wb") as file:  # the same every hour
        for _ in range(3600):
            file.write(scene.block(RATE))
    process = listen(cli, folder, ["-", "--raw-type", "ri16_le", "--raw-rate", str(RATE)], stdin=subprocess.PIPE)
    for hour in range(hours):
        resident = []
        with open(f"{folder}/hour", "rb") as file:
            while second := file.read(2 * RATE):
                process.stdin.write(second)
                resident.append(memory(process.pid, "VmRSS"))
                if len(resident) == BEGINNING:
                    forgetMost(process.pid)
        settled = resident[BEGINNING:]
        hourly.append((min(settled), memory(process.pid, "VmHWM"), sum(settled) / len(settled), cpuSeconds(process.pid)))
        least, most, mean, cpu = hourly[-1]
        print(f"hour {hour + 1}: {least / MB:.1f} … {most / MB:.1f} MB, mean {mean / MB:.2f}; {cpu:.0f} s of a processor", flush=True)
    process.stdin.close()
    if process.wait() != 0:
        fail("listen failed")
    share = hourly[-1][3] / (3600 * hours)
    print(f"{100 * share:.2f} % of a core; largest in the last hour {100 * (hourly[-1][1] / hourly[0][1] - 1):+.2f} % of the first's", flush=True)
    compare(cli, folder)
    if share > 0.03 or hourly[-1][1] > 1.01 * hourly[0][1]:
        fail("too much memory or time")


def paced(seconds, isIq, send):
    """Calls send(block) in real time."""
    scene, begin = Scene(isIq), time.monotonic()
    for i in range(int(seconds * RATE / BLOCK)):
        time.sleep(max(0.0, begin + (i + 1) * BLOCK / RATE - time.monotonic()))
        send(scene.block())


def finish(process, begin):
    cpu, seconds = cpuSeconds(process.pid), time.monotonic() - begin
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    if process.wait() != 0:
        fail("listen failed")
    print(f"{100 * cpu / seconds:.2f} % of a core over {seconds:.0f} s, the calibration included", flush=True)


def udp(cli, folder, minutes):
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sender.bind(("127.0.0.1", 0))
    port = sender.getsockname()[1] ^ 1
    process = listen(cli, folder, ["--udp", f"127.0.0.1:{port}", "--udp-sequence", "u32be", "--raw-type", "ri16_le", "--raw-rate", str(RATE)])
    begin, number = time.monotonic(), 0

    def send(block):
        nonlocal number
        for at in range(0, len(block), 960):
            if number % 997 != 5:  # some are lost on the way
                sender.sendto(struct.pack(">I", number) + block[at : at + 960], ("127.0.0.1", port))
            number += 1

    time.sleep(1.0)
    paced(60 * minutes, False, send)
    finish(process, begin)
    compare(cli, folder)


def rtl_tcp(cli, folder, minutes):
    server = socket.create_server(("127.0.0.1", 0))
    process = listen(cli, folder, ["--rtl-tcp", "127.0.0.1:%d" % server.getsockname()[1], "--frequency", "100e6", "--raw-rate", str(RATE)])
    begin, client = time.monotonic(), server.accept()[0]
    client.sendall(b"RTL0" + struct.pack(">II", 5, 29))
    paced(60 * minutes, True, client.sendall)
    finish(process, begin)
    compare(cli, folder)


def sound(cli, folder, minutes):
    os.environ.update(PULSE_SERVER=f"unix:{folder}/native", PULSE_COOKIE=f"{folder}/cookie")
    own = {**os.environ, "HOME": folder, "XDG_RUNTIME_DIR": folder, "XDG_CONFIG_HOME": folder}
    server = subprocess.Popen(
        ["pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--disable-shm=yes", "--use-pid-file=no",
         "-L", f"module-native-protocol-unix auth-anonymous=1 socket={folder}/native",
         "-L", f"module-null-sink sink_name=null rate={RATE} channels=1 channel_map=mono"], env=own, stderr=subprocess.DEVNULL)
    try:
        time.sleep(2.0)
        process = listen(cli, folder, ["--device", "default", "--raw-type", "ri16_le"])
        player = subprocess.Popen(["pacat", "--playback", "--raw", "--format=s16le", f"--rate={RATE}", "--channels=1"], stdin=subprocess.PIPE)
        begin = time.monotonic()
        paced(60 * minutes, False, player.stdin.write)
        finish(process, begin)
        player.kill()
    finally:
        server.kill()
        server.wait()
    compare(cli, folder)


def killOnce(cli, folder, results):
    """Seconds that were in the pipe before the kill, which comes at any moment while more flows in, and are not in the recording."""
    process = listen(cli, folder, ["-", "--raw-type", "ri16_le", "--raw-rate", str(RATE)], stdin=subprocess.PIPE)
    sent, scene, begin = bytearray(), Scene(), time.monotonic()

    def send():
        try:
            while True:
                block = scene.block(RATE // 100)
                os.write(process.stdin.fileno(), block)
                sent.extend(block)
                time.sleep(max(0.0, begin + len(sent) / 2 / RATE - time.monotonic()))
        except BrokenPipeError:
            pass

    sender = threading.Thread(target=send)
    sender.start()
    time.sleep(random.uniform(0.5, 8.0))
    delivered = len(sent)
    process.kill()
    process.wait()
    sender.join()
    kept = open(f"{folder}/heard.sigmf-data", "rb").read() if os.path.exists(f"{folder}/heard.sigmf-data") else b""
    if not bytes(sent).startswith(kept[: len(sent)]):
        return results.append("the recording holds what was never sent")
    if kept and subprocess.run([cli, "info", f"{folder}/heard.sigmf-meta"], stdout=subprocess.DEVNULL).returncode != 0:
        return results.append("the recording cannot be opened")
    results.append(max(0, delivered - len(kept)) / 2 / RATE)


def kill(cli, folder, count):
    results = []
    while len(results) < count:
        threads = []
        for i in range(min(5, count - len(results))):
            own = f"{folder}/{len(results)}-{i}"
            os.mkdir(own)
            threads.append(threading.Thread(target=killOnce, args=(cli, own, results)))
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    for words in results:
        if isinstance(words, str):
            fail(words)
    print(f"killed {count} times: {sum(results) / count:.3f} s lost in the mean, {max(results):.3f} s at most")
    if max(results) > 1.0:
        fail("more than a second was lost")


def drift(cli, folder, ppm):
    """A sender whose clock is slow, until that is told of: at 0.1 s."""
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sender.bind(("127.0.0.1", 0))
    port = sender.getsockname()[1] ^ 1
    process = listen(cli, folder, ["--udp", f"127.0.0.1:{port}", "--udp-sequence", "u32be", "--raw-type", "ri16_le", "--raw-rate", str(RATE)])
    time.sleep(1.0)
    scene, begin, number, told = Scene(), time.monotonic(), 0, []
    while not told and time.monotonic() - begin < 2 * 0.1 / (ppm * 1e-6) + 60:
        sender.sendto(struct.pack(">I", number) + scene.block(RATE // 100), ("127.0.0.1", port))
        number += 1
        time.sleep(max(0.0, begin + number * 0.01 * (1 + ppm * 1e-6) - time.monotonic()))
        if number % 100 == 0:
            told = [json.loads(line) for line in open(f"{folder}/lines.jsonl") if '"notice":"drift"' in line]
    if not told:
        fail("the drift was not told of")
    print(f"{time.monotonic() - begin:.0f} s: {told[0]['message']}", flush=True)
    finish(process, begin)
    seconds = (told[0]["sample"] + told[0]["samples"]) / RATE
    if abs(told[0]["samples"] / RATE / seconds / ppm * 1e6 - 1) > 0.2:
        fail("it is not that drift")
    if os.path.getsize(f"{folder}/heard.sigmf-data") != number * RATE // 100 * 2:
        fail("samples were added or left out")
    compare(cli, folder)


def main():
    jobs = {"pipe": (pipe, 24), "sound": (sound, 10), "udp": (udp, 10), "rtl_tcp": (rtl_tcp, 10), "kill": (kill, 50), "drift": (drift, 100)}
    if len(sys.argv) not in (3, 4) or sys.argv[2] not in jobs:
        sys.exit(__doc__)
    job, amount = jobs[sys.argv[2]]
    with tempfile.TemporaryDirectory() as folder:
        job(os.path.abspath(sys.argv[1]), folder, int(sys.argv[3]) if len(sys.argv) == 4 else amount)


main()
