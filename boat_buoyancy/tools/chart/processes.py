# Copyright 2026 boat_buoyancy maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Work on several processes, with a picture of how far it is."""

import multiprocessing
import os
import signal

PROCESSES = 2


def results(work, progress, what):
    """
    Yield (function, task, function(task)) for every (function, task) in ``work``, in order.

    ``progress`` takes a text before each, which begins with ``what``.
    """
    # Started afresh, not forked: the linear algebra under NumPy may have threads of its own.
    context = multiprocessing.get_context('spawn')
    # Ctrl-C reaches the whole group; only the first process has something to say to it.
    with context.Pool(min(PROCESSES, os.cpu_count() or 1), signal.signal,
                      (signal.SIGINT, signal.SIG_IGN)) as pool:
        for number, (job, result) in enumerate(zip(work, pool.imap(_do, work, chunksize=1))):
            progress(f'{what}: {number + 1} of {len(work)}')
            yield (*job, result)


def _do(job):
    function, task = job
    return function(task)
