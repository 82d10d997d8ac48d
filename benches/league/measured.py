"""Runs one command: measured.py LIMIT WORDS…; prints its seconds, its largest process's peak memory in MiB, its status and output.

A process of its own, as small as Python is: Linux counts the memory of whoever starts a process as that process's.
"""

import json
import os
import signal
import subprocess
import sys
import time

limit, words = float(sys.argv[1]), sys.argv[2:]
start = time.perf_counter()
with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True) as child:
    signal.signal(signal.SIGALRM, lambda *_: os.killpg(child.pid, signal.SIGKILL))
    signal.setitimer(signal.ITIMER_REAL, limit)
    output = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)
    seconds = time.perf_counter() - start
    child.returncode = os.waitstatus_to_exitcode(status)
record = {"seconds": seconds, "peak_mib": usage.ru_maxrss / 1024, "status": child.returncode, "gave_up": seconds >= limit}
print(json.dumps({**record, "output": output}))
