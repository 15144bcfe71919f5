"""Runs a program many times from one start: fork_server.c, preloaded, forks before the program's main."""

import os
import queue
import select
import signal
import struct
import subprocess
import tempfile
import time
from pathlib import Path

WALL = 3600  # seconds: of a process that waits; processor time has a limit of its own
GIGABYTE = 1 << 30
MEMORY = 4 * GIGABYTE  # of a run of a program with sanitizers, which reserves terabytes of addresses
ENVIRONMENT = {**os.environ, "NO_COLOR": "1", "UBSAN_OPTIONS": "halt_on_error=1:exitcode=99:print_stacktrace=1",
               "ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=1:exitcode=99"}


class Server:
    """One started program, stopped before its main."""

    def __init__(self, program, library):
        asan = [line.split()[2] for line in subprocess.run(["ldd", program], capture_output=True, text=True,
                                                           check=True).stdout.splitlines() if "libasan" in line]
        self.addresses = 0 if asan else 8 * GIGABYTE
        requests, self.requests = os.pipe()
        self.answers, answers = os.pipe()
        environment = {**ENVIRONMENT, "LD_PRELOAD": " ".join([*asan, library]),
                       "CAMPAIGN_REQUESTS": str(requests), "CAMPAIGN_ANSWERS": str(answers)}
        self.process = subprocess.Popen([program], env=environment, pass_fds=(requests, answers),
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(requests)
        os.close(answers)

    def answer(self):
        data = os.read(self.answers, 4)
        if len(data) != 4:
            raise RuntimeError("the program ended before its main")
        return struct.unpack("i", data)[0]

    def run(self, arguments, folder, timeout):
        """Returns the exit code (minus the signal; None if it takes too long or too much memory) and both outputs."""
        with tempfile.TemporaryDirectory(prefix="campaign.said.") as said:
            out, err = Path(said) / "out", Path(said) / "err"
            words = [folder, out, err, timeout, GIGABYTE, self.addresses, *arguments]
            request = b"".join(os.fsencode(str(word)) + b"\0" for word in words)
            os.write(self.requests, struct.pack("I", len(request)) + request)
            process, end, memory = self.answer(), time.monotonic() + WALL, 0
            while not select.select([self.answers], [], [], 0.5)[0]:
                try:
                    memory = int(Path(f"/proc/{process}/statm").read_text().split()[1]) * 4096
                except (OSError, IndexError):
                    continue
                if time.monotonic() > end or memory > MEMORY:
                    os.kill(process, signal.SIGKILL)
                    self.answer()
                    return None, out.read_text(errors="replace"), err.read_text(errors="replace")
            code = os.waitstatus_to_exitcode(self.answer())
            return (None if code == -signal.SIGXCPU else code, out.read_text(errors="replace"),
                    err.read_text(errors="replace"))

    def close(self):
        os.close(self.requests)
        self.process.wait()
        os.close(self.answers)


class Program:
    """A program and as many servers as run at a time. Call: (arguments, folder, timeout) to (code, out, err)."""

    def __init__(self, path, servers, folder):
        library = str(Path(folder) / "fork_server.so")
        source = Path(__file__).with_name("fork_server.c")
        subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], check=True)
        self.free, self.all = queue.Queue(), []
        for _ in range(servers):
            self.all.append(Server(str(Path(path).resolve()), library))
            self.free.put(self.all[-1])

    def __call__(self, arguments, folder, timeout=120):
        server = self.free.get()
        try:
            return server.run(arguments, folder, timeout)
        finally:
            self.free.put(server)

    def close(self):
        for server in self.all:
            server.close()
