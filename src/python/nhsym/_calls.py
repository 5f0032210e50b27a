"""Calls that may take long.

While C code runs in the main thread Python does not look at signals.  So such calls of the main thread run in a thread of their own, always the same one (the library keeps
memory for every thread that it works in), and the main thread waits, where Ctrl-C reaches it: it then asks the library to stop.
"""
import atexit
import os
import queue
import threading
from typing import Any

from ._library import PROGRESS, UsageError, library


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a computation; `partial`: the result of what was computed until then, or None.

    Examples
    --------
    >>> try:
    ...     analysis = nhsym.system("damped_oscillator").analyze()
    ... except nhsym.Interrupted as stop:
    ...     analysis = stop.partial
    """

    def __init__(self, partial: Any = None) -> None:
        super().__init__("interrupted")
        self.partial = partial


class _Job:
    def __init__(self, work):
        self.work, self.done, self.result, self.failure = work, threading.Event(), None, None

    def run(self):
        try:
            self.result = self.work()
        except BaseException as failure:  # it is raised again where the result is awaited
            self.failure = failure
        self.work = None
        self.done.set()


class _Worker:
    def __init__(self):
        self.jobs = queue.SimpleQueue()
        self.thread = None

    def _serve(self):
        for job in iter(self.jobs.get, None):
            job.run()

    def put(self, job):
        if self.thread is None:
            self.thread = threading.Thread(target=self._serve, name="nhsym", daemon=True)
            self.thread.start()
        self.jobs.put(job)

    def stop(self):
        if self.thread is not None:
            self.jobs.put(None)
            self.thread.join()


_worker = _Worker()


def _renew():
    global _worker
    _worker = _Worker()  # a child process has none of its parent's threads


def _end():
    global _worker
    _worker.stop()
    _worker = None  # what ends with the interpreter is freed where it is


os.register_at_fork(after_in_child=_renew)
atexit.register(_end)


def _elsewhere():
    return _worker is not None and threading.current_thread() is threading.main_thread()


class Context:
    """nh_context: one computation at a time, in any thread."""

    def __init__(self):
        self.lock = threading.Lock()
        self.address = library().nh_context_create()
        self.failure = None

    def __del__(self):
        if getattr(self, "address", None):
            library().nh_context_free(self.address)

    def call(self, work, progress=None):
        """work() without the signals of the main thread; progress(doing, part) is called from the computing thread."""
        if progress is not None and not callable(progress):
            raise UsageError("progress is no function: %r" % (progress,), "progress=lambda doing, part: print(doing)")
        with self.lock:
            self.failure = None
            told = self._tell(progress) if progress else None
            if told:
                library().nh_context_on_progress(self.address, told, None)
            try:
                result = self._run(work)
            finally:
                if told:
                    library().nh_context_on_progress(self.address, PROGRESS(0), None)
            if self.failure:
                raise self.failure
            return result

    def _tell(self, progress):
        def tell(_, doing, part):
            if self.failure:
                return
            try:
                progress(doing.decode(), part if part >= 0 else None)
            except BaseException as failure:  # through C it could not pass
                self.failure = failure
                library().nh_context_interrupt(self.address)
        return PROGRESS(tell)

    def _run(self, work):
        if not _elsewhere():
            return work()
        job, last = _Job(work), _Job(lambda: None)
        try:
            _worker.put(job)
            while not job.done.wait(0.1):  # a signal that comes just before a wait does not end it
                pass
        except KeyboardInterrupt:
            _worker.put(last)  # done after the job, or without it if it was not put
            while not last.done.wait(0.02):  # again and again: it may not have begun
                library().nh_context_interrupt(self.address)
            raise Interrupted(job.result) from None
        if job.failure:
            raise job.failure
        return job.result


def free_later(free, address):
    """Free an object in the thread that made it."""
    if _elsewhere() and _worker.thread is not None:
        _worker.put(_Job(lambda: free(address)))
    else:
        free(address)
